"""Linkages to scale: pictures in any pose, animations, and plots of their motion."""
