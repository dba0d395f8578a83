//! The web page in which kernels are chosen, edited and seen: its files, and what they need to stand alone.
