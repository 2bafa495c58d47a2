"""Planning: from what was seen to footsteps and motion plans. Knows no sensor."""
