"""Linkages moved: dyads in closed form, larger groups by Newton's method, curves of positions."""
