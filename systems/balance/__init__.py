"""Balance: contact wrench cones, static stability, ZMP preview, stabilisation."""
