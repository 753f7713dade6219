"""The report's figures 3 to 31, drawn from our own runs, and its numbers beside ours."""
