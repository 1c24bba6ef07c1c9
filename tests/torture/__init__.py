"""Slow tests against hostile input and sudden ends; docs/reliability.md says what they do and what they found."""
