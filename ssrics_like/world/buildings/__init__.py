"""How buildings are drawn from plans, made up, and furnished."""
