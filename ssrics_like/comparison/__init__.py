"""Human and robot choices of landmarks: matching, agreement, chance."""
