"""The word-address controls by maker: data, and the few functions in which they really differ."""
