"""Commands that remake the figures and tables of the documentation, and the data that TAMP ships."""
