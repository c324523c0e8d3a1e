/**
 * Live drawings in MyST and Jupyter Book 2: code blocks of the language `lsystem` become frames of the playground. MyST
 * keeps no elements of other kinds, so this reads the labelled lines as the element `<l-system>` does.
 */

/** The folder with embed.html: the address of a playground. */
const HOME = process.env.LSYSTEM_HOME ?? 'https://example.org/l-systems/';

/** Attributes of the element whose keys in links are other ones. */
const KEYS = { caption: 'title', stroke: 'width' };

/** Labels that belong to the rules. */
const RULES = ['ignore', 'consider', 'draw', 'homomorphism', 'interpretation'];

/** The hash of a link. */
function link(text) {
    const rules = text
        .split('\n')
        .map((line) => line.trim())
        .filter((line) => line !== '');
    const fields = new Map();
    for (;;) {
        const [, name, value] = rules[0]?.match(/^([a-z]+):\s*(.*)$/) ?? [];
        if (!name || RULES.includes(name)) break;
        const key = KEYS[name] ?? name;
        fields.set(key, key === 'do' && fields.has(key) ? `${fields.get(key)}\n${value}` : value);
        rules.shift();
    }
    for (const key of ['bg', 'palette']) if (fields.has(key)) fields.set(key, fields.get(key).replace(/[#\s]/g, ''));
    if (!['auto', 'colour', 'width', 'thinner'].some((key) => fields.has(key))) fields.set('auto', '1');
    fields.set('rules', rules.join('\n'));
    return `#v=1${[...fields].map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join('')}`;
}

const transform = {
    name: 'lsystem',
    stage: 'document',
    plugin: (_, { selectAll }) => {
        return (tree) => {
            for (const node of selectAll('code[lang=lsystem]', tree))
                Object.assign(node, { type: 'iframe', src: `${HOME}embed.html${link(node.value)}`, width: '100%' });
        };
    },
};

export default { name: 'L-systems', transforms: [transform] };
