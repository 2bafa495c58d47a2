"""What is known of a staircase after several scans."""
