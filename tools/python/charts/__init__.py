"""Charts and pages of `tamp study` and `tamp compare`, from the JSON files that they write; the same file gives the same bytes."""
