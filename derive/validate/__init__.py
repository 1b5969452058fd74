"""Translation validation: the emitted files, read back, against the record they were made from."""
