"""A right-hand side that someone wrote, beside ours: do they agree, and if not, by what?"""
