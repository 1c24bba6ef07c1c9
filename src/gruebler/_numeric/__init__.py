"""Kernels on bare arrays and bare numbers: nothing here knows a chain, a pair or a file."""
