"""From a scenario file to a results folder: schema, runner, tables.

Nothing is imported here: the schema alone needs no numba, the runner does.
"""
