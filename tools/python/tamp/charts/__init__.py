"""Charts and pages of `tamp study` and `tamp compare`, from their JSON files; the same file gives the same bytes."""
