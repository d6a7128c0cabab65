"""A cognitive architecture module that lets a robot mark landmarks the way people do."""

__version__ = "0.1.0"
