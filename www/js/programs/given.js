/**
 * The given functions of the ready-made sets: the truth, and what stands in for functions that are not written yet. Each
 * gets the others as `own`, so that a function of a student calls the student's own earlier ones. Matrices are lists of
 * their columns; angles are degrees.
 */

/** @typedef {Record<string, any>} Own */
/** @typedef {number[]} Vector */
/** @typedef {Record<string, string>} Rules */

/** In JavaScript: as functions for the page, and as texts for the frame. @type {Readonly<Record<string, (own: Own) => (...args: any[]) => any>>} */
export const GIVEN = {
    derivation: () => (/** @type {string} */ word, /** @type {Rules} */ rules) =>
        [...word].map((symbol) => rules[symbol] ?? symbol).join(''),
    generation: (own) => (/** @type {string} */ axiom, /** @type {Rules} */ rules, /** @type {number} */ n) => {
        let word = axiom;
        for (let step = 0; step < n; step++) word = own['derivation'](word, rules);
        return word;
    },
    degreetorad: () => (/** @type {number} */ angle) => (angle * Math.PI) / 180,
    multmatvector: () => (/** @type {Vector[]} */ matrix, /** @type {Vector} */ vector) =>
        (matrix[0] ?? []).map((_, row) => vector.reduce((sum, value, at) => sum + value * (matrix[at]?.[row] ?? 0), 0)),
    multmat: (own) => (/** @type {Vector[]} */ a, /** @type {Vector[]} */ b) =>
        b.map((column) => own['multmatvector'](a, column)),
    r2d: (own) => (/** @type {number} */ angle) => {
        const turn = own['degreetorad'](angle);
        const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
        return [
            [cos, sin],
            [-sin, cos],
        ];
    },
    move2d: (own) => (/** @type {Vector} */ position, /** @type {number} */ angle, /** @type {number} */ distance) => {
        const step = own['multmatvector'](own['r2d'](angle), [distance, 0]);
        return position.map((value, axis) => value + step[axis]);
    },
    axiomtoline2d:
        (own) =>
        (
            /** @type {string} */ word,
            /** @type {Vector} */ start,
            /** @type {number} */ heading,
            /** @type {number} */ left,
            /** @type {number} */ right,
            /** @type {number} */ step,
        ) => {
            const [lines, stack] = [/** @type {Vector[][]} */ ([]), /** @type {[Vector, number][]} */ ([])];
            let [position, angle] = [start, heading];
            for (const symbol of word) {
                if (symbol === 'F' || symbol === 'G') {
                    const end = own['move2d'](position, angle, step);
                    lines.push([position, end]);
                    position = end;
                } else if (symbol === '+') angle += left;
                else if (symbol === '-') angle -= right;
                else if (symbol === '[') stack.push([position, angle]);
                else if (symbol === ']' && stack.length > 0) [position, angle] = stack.pop() ?? [position, angle];
            }
            return lines;
        },
    ru: (own) => (/** @type {number} */ angle) => {
        const [[cos, sin]] = own['r2d'](angle);
        return [
            [cos, sin, 0],
            [-sin, cos, 0],
            [0, 0, 1],
        ];
    },
    rl: (own) => (/** @type {number} */ angle) => {
        const [[cos, sin]] = own['r2d'](angle);
        return [
            [1, 0, 0],
            [0, cos, sin],
            [0, -sin, cos],
        ];
    },
    rh: (own) => (/** @type {number} */ angle) => {
        const [[cos, sin]] = own['r2d'](angle);
        return [
            [cos, 0, -sin],
            [0, 1, 0],
            [sin, 0, cos],
        ];
    },
    move3d:
        (own) => (/** @type {Vector} */ position, /** @type {Vector[]} */ matrix, /** @type {number} */ distance) => {
            const step = own['multmatvector'](matrix, [distance, 0, 0]);
            return position.map((value, axis) => value + step[axis]);
        },
    axiomtoline3d:
        (own) =>
        (
            /** @type {string} */ word,
            /** @type {Vector} */ start,
            /** @type {number} */ heading,
            /** @type {Record<string, number>} */ angles,
            /** @type {number} */ step,
        ) => {
            const { l = 0, r = 0, u = 0, d = 0, t = 0, v = 0 } = angles;
            /** @type {Record<string, [string, number]>} */
            const turns = {
                '+': ['ru', l],
                '-': ['ru', -r],
                '&': ['rl', d],
                '^': ['rl', -u],
                '>': ['rh', t],
                '<': ['rh', -v],
            };
            const [lines, stack] = [/** @type {Vector[][]} */ ([]), /** @type {[Vector, Vector[]][]} */ ([])];
            let [position, matrix] = [start, own['ru'](heading)];
            for (const symbol of word) {
                const [name, angle] = turns[symbol] ?? [];
                if (name) matrix = own['multmat'](matrix, own[name](angle));
                else if (symbol === 'F' || symbol === 'G') {
                    const end = own['move3d'](position, matrix, step);
                    lines.push([position, end]);
                    position = end;
                } else if (symbol === '[') stack.push([position, matrix]);
                else if (symbol === ']' && stack.length > 0) [position, matrix] = stack.pop() ?? [position, matrix];
            }
            return lines;
        },
    expandSymbol: () => (/** @type {string} */ symbol, /** @type {Rules} */ rules) => rules[symbol] ?? symbol,
    expandOnce: (own) => (/** @type {string} */ word, /** @type {Rules} */ rules) =>
        [...word].map((symbol) => own['expandSymbol'](symbol, rules)).join(''),
    expand: (own) => (/** @type {string} */ axiom, /** @type {Rules} */ rules, /** @type {number} */ n) => {
        let word = axiom;
        for (let step = 0; step < n; step++) word = own['expandOnce'](word, rules);
        return word;
    },
    draw: () => (/** @type {string} */ word, /** @type {number} */ angle) => {
        const [lines, stack] = [/** @type {Vector[][]} */ ([]), /** @type {number[][]} */ ([])];
        let [x, y, heading] = [0, 0, 90];
        for (const symbol of word) {
            if (symbol === '+') heading += angle;
            else if (symbol === '-') heading -= angle;
            else if (symbol === '[') stack.push([x, y, heading]);
            else if (symbol === ']') [x = 0, y = 0, heading = 0] = stack.pop() ?? [x, y, heading];
            else {
                const turn = (heading * Math.PI) / 180;
                const end = [x + Math.cos(turn), y + Math.sin(turn)];
                lines.push([[x, y], end]);
                [x = 0, y = 0] = end;
            }
        }
        return lines;
    },
};

/** The same in Python. */
export const GIVEN_PYTHON = `
import math as _math
def derivation(word, rules):
    return "".join(rules.get(symbol, symbol) for symbol in word)
def generation(axiom, rules, n):
    word = axiom
    for step in range(n):
        word = derivation(word, rules)
    return word
def degreetorad(angle):
    return angle * _math.pi / 180
def multmatvector(matrix, vector):
    return [sum(matrix[at][row] * vector[at] for at in range(len(vector))) for row in range(len(matrix[0]))]
def multmat(a, b):
    return [multmatvector(a, column) for column in b]
def r2d(angle):
    turn = degreetorad(angle)
    return [[_math.cos(turn), _math.sin(turn)], [-_math.sin(turn), _math.cos(turn)]]
def move2d(position, angle, distance):
    step = multmatvector(r2d(angle), [distance, 0])
    return [position[0] + step[0], position[1] + step[1]]
def axiomtoline2d(word, position, heading, left, right, step):
    lines, stack = [], []
    for symbol in word:
        if symbol in "FG":
            end = move2d(position, heading, step)
            lines.append([position, end])
            position = end
        elif symbol == "+":
            heading += left
        elif symbol == "-":
            heading -= right
        elif symbol == "[":
            stack.append((position, heading))
        elif symbol == "]" and stack:
            position, heading = stack.pop()
    return lines
def ru(angle):
    (c, s), _ = r2d(angle)
    return [[c, s, 0], [-s, c, 0], [0, 0, 1]]
def rl(angle):
    (c, s), _ = r2d(angle)
    return [[1, 0, 0], [0, c, s], [0, -s, c]]
def rh(angle):
    (c, s), _ = r2d(angle)
    return [[c, 0, -s], [0, 1, 0], [s, 0, c]]
def move3d(position, matrix, distance):
    step = multmatvector(matrix, [distance, 0, 0])
    return [position[axis] + step[axis] for axis in range(3)]
def axiomtoline3d(word, position, heading, angles, step):
    turns = {"+": (ru, angles["l"]), "-": (ru, -angles["r"]), "&": (rl, angles["d"]), "^": (rl, -angles["u"]),
             ">": (rh, angles["t"]), "<": (rh, -angles["v"])}
    lines, stack, matrix = [], [], ru(heading)
    for symbol in word:
        if symbol in turns:
            turn, angle = turns[symbol]
            matrix = multmat(matrix, turn(angle))
        elif symbol in "FG":
            end = move3d(position, matrix, step)
            lines.append([position, end])
            position = end
        elif symbol == "[":
            stack.append((position, matrix))
        elif symbol == "]" and stack:
            position, matrix = stack.pop()
    return lines
def expandSymbol(symbol, rules):
    return rules.get(symbol, symbol)
def expandOnce(word, rules):
    return "".join(expandSymbol(symbol, rules) for symbol in word)
def expand(axiom, rules, n):
    word = axiom
    for step in range(n):
        word = expandOnce(word, rules)
    return word
def draw(word, angle):
    lines, stack, x, y, heading = [], [], 0, 0, 90
    for symbol in word:
        if symbol == "+":
            heading += angle
        elif symbol == "-":
            heading -= angle
        elif symbol == "[":
            stack.append((x, y, heading))
        elif symbol == "]":
            if stack:
                x, y, heading = stack.pop()
        else:
            turn = _math.radians(heading)
            end = [x + _math.cos(turn), y + _math.sin(turn)]
            lines.append([[x, y], end])
            x, y = end
    return lines
`;

/** The given functions, as the page calls them. @returns {Own} */
export function truth() {
    /** @type {Own} */
    const own = {};
    for (const [name, made] of Object.entries(GIVEN)) own[name] = made(own);
    return own;
}

/** The given functions of a language as a text, which the program's own ones replace. @param {import('./runner.js').Language} language */
export const givenIn = (language) =>
    language === 'python'
        ? GIVEN_PYTHON
        : Object.entries(GIVEN)
              .map(([name, made]) => `self.${name}=(${made})(self);`)
              .join('\n');
