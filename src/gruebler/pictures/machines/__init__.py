"""Pictures of cams, Geneva drives and gear trains, to scale."""
