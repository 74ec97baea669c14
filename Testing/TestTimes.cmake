# Usual seconds of the tests that take 3 s and longer, by scripts/test_times.py.
