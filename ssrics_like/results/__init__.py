"""The results folder: its tables, its files, and how runs get into it unharmed."""
