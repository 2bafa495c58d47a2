"""What the robot believes of itself: contacts, base, and the body that follows."""
