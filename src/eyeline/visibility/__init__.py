"""Visible-surface detection: one question, several answers, one file a method."""
