"""Many plain blocks at once, as arrays: the same findings and the same moves as block by block, to the last bit."""
