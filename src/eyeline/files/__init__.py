"""Readers and writers, by suffix."""
