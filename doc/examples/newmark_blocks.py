"""Two of Newmark's blocks under a made-up earthquake: how far they slide, and a picture."""
from yade.nonsmooth import figures, newmark
from yade.nonsmooth.ground_motion import synthetic

motion = synthetic.stochastic(peak=4, duration=20, frequency=1.5, seed=3, vertical_peak=2)
# a record: ground_motion.read("STATION-E.AT2", vertical="STATION-V.AT2")
print(motion.describe())

slides = []
for friction in (0.45, 0.5):
    block = newmark.Block(dip=20, friction=friction)
    slide = newmark.slide(block, motion)
    print(f"friction {friction}: yields at {block.yield_acceleration():.2f} m/s², slides {slide.permanent:.3f} m")
    slides.append((f"Newmark's block, μ = {friction}", slide.times, slide.displacement))

t = motion.times
ground = motion.acceleration(t), motion.velocity(t), motion.displacement(t)
figures.shaking(t, *ground, blocks=slides, title=motion.name, path="shaking.png")
