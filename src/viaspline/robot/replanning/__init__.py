"""What a robot does about something in its way."""
