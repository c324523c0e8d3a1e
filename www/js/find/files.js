/** Pictures among files, before anything of the search is loaded. */

/** Whether a file looks like a picture, by its name and type. @param {File} file */
export const isPicture = ({ name, type }) => /^image\//.test(type) || /\.(png|jpe?g|webp|svg|gif)$/i.test(name);

/** The picture among what was pasted or dropped, if there is one. @param {DataTransfer | null} data */
export const pictureIn = (data) => [...(data?.files ?? [])].find(isPicture) ?? null;
