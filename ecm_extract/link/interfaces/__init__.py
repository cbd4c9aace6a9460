"""Message, service and action types that expressions of both languages mean."""
