/**
 * <l-system axiom="X" angle="25" n="5" controls="angle,n">X -> F[+X]-X</l-system>: a live drawing in any page.
 *
 * It is built into one classic script, because other sites may not import our modules. The drawing is embed.html in a frame, from beside
 * this script; attributes go there as messages, and what happens there comes back as events. docs/embedding.md tells
 * all of it.
 */
import { ATTRIBUTES } from './js/tables.js';

(() => {
    const script = document.currentScript;
    const HOME = new URL('embed.html', script instanceof HTMLScriptElement && script.src ? script.src : location.href);
    /** Pages from a disk have no origin that could be told from another's. */
    const ORIGIN = HOME.protocol === 'file:' ? null : HOME.origin;

    /** Attributes that are values of the drawing, and their keys in links. */
    const KEYS = new Map(Object.entries(ATTRIBUTES));
    const PAUSE = 40;

    const STYLE = `
        :host { display: block; aspect-ratio: 4 / 3; min-height: 12rem; contain: content; }
        :host([hidden]) { display: none; }
        iframe { display: block; width: 100%; height: 100%; border: 0; color-scheme: normal; }
        @media print { :host { break-inside: avoid; } }`;

    class LSystem extends HTMLElement {
        static observedAttributes = ['link', 'controls', 'theme', 'loading', ...KEYS.keys()];

        /** @type {HTMLIFrameElement | null} */
        #frame = null;
        /** What the frame has been told, by key. @type {Record<string, string>} */
        #told = {};
        #timer = 0;
        /** Whether the frame listens, and what was said before it did. */
        #heard = false;
        /** @type {object[]} */
        #unsaid = [];
        #ready = false;
        #lastId = 0;
        /** @type {Map<number, (state: Record<string, unknown>) => void>} */
        #asked = new Map();
        /** What came last from the frame. @type {{values: Record<string, unknown>, link: string} | null} */
        #state = null;
        #observer = new MutationObserver(() => this.#changed());

        connectedCallback() {
            addEventListener('message', this.#hear);
            this.#observer.observe(this, { childList: true, characterData: true, subtree: true });
            // The text comes after the tag.
            if (document.readyState === 'loading') document.addEventListener('DOMContentLoaded', this.#build, { once: true });
            else queueMicrotask(this.#build);
        }

        disconnectedCallback() {
            removeEventListener('message', this.#hear);
            document.removeEventListener('DOMContentLoaded', this.#build);
            this.#observer.disconnect();
            clearTimeout(this.#timer);
            this.#frame?.remove();
            this.#frame = null;
            this.#ready = false;
            this.#heard = false;
        }

        /** @param {string} name @param {string | null} before @param {string | null} now */
        attributeChangedCallback(name, before, now) {
            if (before === now || !this.#frame) return;
            if (name === 'link' || name === 'theme') this.#load();
            else if (name === 'controls') this.#say({ lsystem: 'controls', controls: now ?? '' });
            else if (name === 'loading') this.#frame.loading = now === 'eager' ? 'eager' : 'lazy';
            else this.#changed();
        }

        /** The drawing as the visitor has left it, by the keys of links. Null before it is there. */
        get values() {
            return this.#state?.values ?? null;
        }

        /** The drawing as the visitor has left it, as the part of an address behind `#`, with the `#`. */
        get state() {
            return this.#state?.link ?? null;
        }

        /** Whether the first picture is there. */
        get ready() {
            return this.#ready;
        }

        /**
         * Sets values by the keys of links, as attributes do.
         * @param {Record<string, unknown>} values
         */
        set(values) {
            this.#say({ lsystem: 'set', values });
        }

        /** Opens a whole drawing. @param {string} link an address of the playground, or the part of it behind `#` */
        open(link) {
            this.#say({ lsystem: 'open', link: hashOf(link) });
        }

        /** Takes back what the visitor has changed. */
        reset() {
            this.#say({ lsystem: 'reset' });
        }

        play() {
            this.#say({ lsystem: 'play' });
        }

        pause() {
            this.#say({ lsystem: 'pause' });
        }

        /** The drawing as it is now, with a description of it and the exact numbers of its symbols and segments. @returns {Promise<Record<string, unknown>>} */
        get() {
            return new Promise((resolve) => {
                const id = ++this.#lastId;
                this.#asked.set(id, resolve);
                this.#say({ lsystem: 'get', id });
            });
        }

        focus() {
            this.#frame?.focus();
        }

        #build = () => {
            if (!this.isConnected || this.#frame) return;
            const root = this.shadowRoot ?? this.attachShadow({ mode: 'open' });
            // Not an element, which the policy of a page might refuse.
            const style = new CSSStyleSheet();
            style.replaceSync(STYLE);
            root.adoptedStyleSheets = [style];
            this.#frame = document.createElement('iframe');
            this.#frame.loading = this.getAttribute('loading') === 'eager' ? 'eager' : 'lazy';
            this.#frame.allow = 'clipboard-write';
            this.#frame.part = 'frame';
            root.replaceChildren(this.#frame);
            this.#load();
        };

        /** Gives the frame its address, which says all. */
        #load() {
            if (!this.#frame) return;
            this.#told = this.#given();
            const name = this.getAttribute('aria-label') ?? this.#told.title;
            this.#frame.title = name ? `L-system: ${name}` : 'L-system';
            const link = hashOf(this.getAttribute('link') ?? '').replace(/^#/, '');
            const fields = { ...this.#told, controls: this.getAttribute('controls') ?? '', theme: this.getAttribute('theme') ?? '', host: location.origin === 'null' ? '' : location.origin };
            const own = Object.entries(fields).flatMap(([key, value]) => (value === '' ? [] : [`${key}=${encodeURIComponent(value)}`]));
            const address = new URL(HOME);
            address.hash = [link || 'v=1', ...own].join('&');
            // Later ones leave no trace in the history of the page.
            if (this.#heard) this.#frame.contentWindow?.location.replace(address.href);
            else this.#frame.src = address.href;
        }

        /** The values that attributes and text give, as strings. @returns {Record<string, string>} */
        #given() {
            const values = Object.fromEntries([...KEYS].flatMap(([name, key]) => (this.hasAttribute(name) ? [[key, this.getAttribute(name) ?? '']] : [])));
            if (values.rules === undefined) {
                const text = rulesIn(this);
                if (text !== '') values.rules = text;
            }
            // Links write colours without the sign that HTML has before them.
            for (const key of ['bg', 'palette']) if (values[key] !== undefined) values[key] = values[key].replace(/[#\s]/g, '');
            return values;
        }

        /** Tells the frame what has changed; changes that come together are told together. */
        #changed() {
            if (!this.#frame) return;
            clearTimeout(this.#timer);
            this.#timer = window.setTimeout(() => {
                const given = this.#given();
                // What is no longer said is what it would be unsaid, which only a fresh address tells.
                if (Object.keys(this.#told).some((key) => !(key in given))) return this.#load();
                const values = Object.fromEntries(Object.entries(given).filter(([key, value]) => this.#told[key] !== value));
                this.#told = given;
                if (Object.keys(values).length > 0) this.#say({ lsystem: 'set', values });
            }, PAUSE);
        }

        /** @param {object} message */
        #say(message) {
            if (this.#heard && this.#frame?.contentWindow) this.#frame.contentWindow.postMessage(message, ORIGIN ?? '*');
            else this.#unsaid.push(message);
        }

        /** @param {MessageEvent} event */
        #hear = (event) => {
            const { data, source, origin } = event;
            if (!this.#frame || source !== this.#frame.contentWindow || (ORIGIN !== null && origin !== ORIGIN)) return;
            if (typeof data !== 'object' || data === null || typeof data.lsystem !== 'string') return;
            const { lsystem: kind, ...detail } = data;
            if (kind === 'hello') {
                this.#heard = true;
                // By its own words the frame knows whom to answer.
                this.#say({ lsystem: 'hello' });
                const waiting = this.#unsaid;
                this.#unsaid = [];
                for (const message of waiting) this.#say(message);
                return;
            }
            if (detail.values) this.#state = { values: detail.values, link: detail.link };
            if (kind === 'state') {
                this.#asked.get(detail.id)?.(detail);
                this.#asked.delete(detail.id);
            } else if (kind === 'ready' || kind === 'change' || kind === 'error') {
                if (kind === 'ready') this.#ready = true;
                this.dispatchEvent(new CustomEvent(kind, { detail }));
            }
        };
    }

    /** The part of an address behind `#`. @param {string} address */
    function hashOf(address) {
        return address.includes('#') ? address.slice(address.indexOf('#')) : address;
    }

    /** Rules as text: of a `pre` where there is one, which pages without JavaScript show; else the element's own. @param {HTMLElement} element */
    function rulesIn(element) {
        const own = [...element.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE).map((node) => node.textContent ?? '');
        const text = element.querySelector('pre')?.textContent ?? own.join('\n');
        return text
            .split('\n')
            .map((line) => line.trim())
            .filter((line) => line !== '')
            .join('\n');
    }

    if (!customElements.get('l-system')) customElements.define('l-system', LSystem);
})();
