/** Names of the topics under which cameras' pictures are recorded. */

const PREFIX = '/farpoint/pictures/';

/**
 * A camera's name with `_` in place of characters that are invalid in topics: `Front` and `/front/image_raw` become
 * `Front` and `front_image_raw`.
 */
export function pictureTopics(cameras: readonly string[]): string[] {
  const taken = new Set<string>();
  return cameras.map((camera) => {
    const plain = camera.replace(/^\/+/, '').replaceAll(/[^A-Za-z0-9_]/g, '_') || 'camera';
    const name = /^[0-9]/.test(plain) ? `_${plain}` : plain;
    let free = name;
    for (let n = 2; taken.has(free); n++) free = `${name}_${n}`;
    taken.add(free);
    return PREFIX + free;
  });
}
