"""From raw messages to streams, transforms, statuses and states; the same for a live graph and a recording."""
