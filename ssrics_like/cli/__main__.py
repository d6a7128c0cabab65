"""Makes ``python -m ssrics_like.cli`` the same as ``ssrics``."""

from ssrics_like.cli import main

main()
