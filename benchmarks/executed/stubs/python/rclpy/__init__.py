def init(args=None):
    pass
