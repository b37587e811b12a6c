"""What is asked of the model: a slope, laboratory tests, columns and piles, lessons, the paper beside ours, hard beside
soft.

They stand in this order, and a study imports only from those before it: slope, laboratory, heaps, lessons; campaigns;
paper, comparison.
"""
