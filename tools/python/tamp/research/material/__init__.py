"""Material points along paths, and curves of materials."""
