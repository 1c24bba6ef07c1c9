"""The figures of benchmarks/README.md: `python -m benchmarks [NAME ...]`."""
