"""What is believed of things that move and were seen: estimates, tubes, and what touched whom."""
