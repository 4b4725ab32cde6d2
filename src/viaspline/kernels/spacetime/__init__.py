"""Places and times searched together: where a robot can be when, past what moves."""
