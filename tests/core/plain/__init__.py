"""Motions in plain, slow Python: dyads, closing conditions and their derivatives, what the core is compared with."""
