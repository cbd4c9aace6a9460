"""The operations: may this be installed, invoked, composed, chained, upgraded, run as one system?"""
