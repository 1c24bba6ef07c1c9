"""A page to pick, drag and see: its model, its server, the notebook widget, the single file."""
