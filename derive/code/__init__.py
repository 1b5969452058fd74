"""From a record to numeric code."""
