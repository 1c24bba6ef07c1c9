"""Chains counted and listed: contracted graphs, strings of links, Burnside's lemma."""
