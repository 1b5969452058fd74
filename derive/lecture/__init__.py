"""The lecture: a text for people whose claims are tied to steps of the walk, and tried again."""
