"""Runs programs with a stub of the module `turtle`, and prints a line with the ends of all lines for each.

python3 drive.py ROLL FILE... : every random choice takes the share ROLL (0 to 1) of the weights.
"""

import itertools
import math
import random
import sys
import types


class Turtle:
    def __init__(self, visible=True):
        self.x, self.y, self.degrees, self.draws = 0.0, 0.0, 0.0, True

    def penup(self):
        self.draws = False

    def pendown(self):
        self.draws = True

    def heading(self):
        return self.degrees

    def setheading(self, degrees):
        self.degrees = degrees

    def left(self, degrees):
        self.degrees += degrees

    def position(self):
        return self.x, self.y

    def setposition(self, position):
        self.go(*position)

    def forward(self, length):
        angle = math.radians(self.degrees)
        self.go(self.x + length * math.cos(angle), self.y + length * math.sin(angle))

    def go(self, x, y):
        if self.draws:
            lines.append((self.x, self.y, x, y))
        self.x, self.y = x, y


class Screen:
    def __init__(self):
        for name in ["setup", "mode", "tracer", "update", "mainloop", "setworldcoordinates"]:
            setattr(self, name, lambda *arguments: None)


def choices(population, weights):
    sums = list(itertools.accumulate(weights))
    return [next(one for one, until in zip(population, sums) if until > roll * sums[-1])]


roll = float(sys.argv[1])
random.choices = choices
sys.modules["turtle"] = types.SimpleNamespace(Turtle=Turtle, Screen=Screen)
for file in sys.argv[2:]:
    lines = []
    with open(file, encoding="utf-8") as source:
        exec(compile(source.read(), file, "exec"), {"__name__": "__main__"})
    print(*(number for line in lines for number in line))
