"""The record of a walk: steps as data, their JSON, vocabulary and sentences."""
