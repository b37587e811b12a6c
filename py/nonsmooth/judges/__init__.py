"""What the rest is held against: checks with known answers, and speed. No other room imports them."""
