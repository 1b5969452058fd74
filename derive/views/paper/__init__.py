"""The equations of the note as printed, beside what is derived."""
