"""What the choice of a method, or of what it is given, does to a run."""
