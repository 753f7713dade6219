"""How commands write the tables of results/."""
