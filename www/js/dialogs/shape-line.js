/** The line of the rules that names a shape. */

/** The rules with a shape in their first line, and its name, which is new. @param {string} rules @param {string} shape @returns {[string, string]} */
export function withShape(rules, shape) {
    const isTaken = (/** @type {string} */ name) => new RegExp(`\\b${name}\\b`).test(rules);
    let name = 'form';
    for (let number = 2; isTaken(name); number++) name = `form${number}`;
    return [`shape ${name} = ${shape}\n${rules}`, name];
}
