"""Runs programs with a stub of the module `turtle`, and prints a line with the ends of all lines for each.

python3 drive.py ROLL FILE... : every random choice takes the share ROLL (0 to 1) of the weights.
"""

import itertools
import random
import sys
import types


class Turtle:
    def __init__(self, visible=True):
        self.x, self.y, self.draws = 0.0, 0.0, True

    def penup(self):
        global lifts
        lifts += 1
        self.draws = False

    def pendown(self):
        self.draws = True

    def speed(self, speed):
        pass

    def setposition(self, x, y):
        if self.draws:
            lines.append((self.x, self.y, x, y))
        self.x, self.y = x, y


class Screen:
    def __init__(self):
        for name in ["setup", "mode", "tracer", "update", "setworldcoordinates"]:
            setattr(self, name, lambda *arguments: None)


def choices(population, weights):
    sums = list(itertools.accumulate(weights))
    return [next(one for one, until in zip(population, sums) if until > roll * sums[-1])]


roll = float(sys.argv[1])
random.choices = choices
sys.modules["turtle"] = types.SimpleNamespace(Turtle=Turtle, Screen=Screen, done=lambda: None)
for file in sys.argv[2:]:
    lines, lifts, program = [], 0, {"__name__": "__main__"}
    with open(file, encoding="utf-8") as source:
        exec(compile(source.read(), file, "exec"), program)
    commands = [command for symbol in program["derive"]() for command, _ in program["ACTIONS"].get(symbol, [])]
    # The pen is lifted for moves and for ways back alone, since each lift begins another line.
    assert lifts <= commands.count("move") + commands.count("pop"), file
    print(*(number for line in lines for number in line))
