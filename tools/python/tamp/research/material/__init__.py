"""One material point along paths, and curves of materials."""
