"""What is printed, read back: a small reader of each format, none of which knows the printers."""
