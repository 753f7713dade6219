"""A laboratory's files, and curves of them."""
