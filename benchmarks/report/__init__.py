"""Tables, pictures and pages of what was measured; nothing in them is typed by hand."""
