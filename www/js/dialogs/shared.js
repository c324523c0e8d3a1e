/** Opens what another program has shared with the installed page: a picture, a file or a text. */

import { toast } from '../base/announce.js';
import { isPicture } from '../find/files.js';
import { say } from '../base/words.js';

/** @param {import('./dialogs.js').Page} page */
export function createShared({ part, open }) {
    return {
        /** Opens what the service worker has kept. */
        async open() {
            const place = new URL('shared', location.href);
            place.hash = place.search = '';
            history.replaceState(history.state, '', location.pathname + location.hash);
            const kept = await caches.open(place.href).then((cache) => cache.match(place.href));
            if (!kept) return toast(say`What was shared did not arrive. Share it again.`);
            await caches.delete(place.href);
            const body = await kept.blob();
            const file = new File([body], decodeURIComponent(kept.headers.get('name') ?? ''), { type: body.type });
            if (file.name === '') return (await part('import'))?.paste(await file.text());
            return open(isPicture(file) ? 'find' : 'file', file);
        },
    };
}
