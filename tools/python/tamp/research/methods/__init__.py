"""Effects of the choice of a method, and of its settings, on a run."""
