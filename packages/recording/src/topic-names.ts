/** Names of the topics under which cameras' pictures and videos, quantities and alarms are recorded. */

export function pictureTopics(cameras: readonly string[]): string[] {
  return topicsUnder('/farpoint/pictures/', cameras, 'camera');
}

export function videoTopics(cameras: readonly string[]): string[] {
  return topicsUnder('/farpoint/videos/', cameras, 'camera');
}

export function quantityTopics(quantities: readonly { topic: string; field: string }[]): string[] {
  const names = quantities.map(({ topic, field }) => (field === 'data' ? topic : `${topic}/${field}`));
  return topicsUnder('/farpoint/quantities/', names, 'quantity');
}

/** @param watched the quantities that the alarms watch */
export function alarmTopics(watched: readonly string[]): string[] {
  return topicsUnder('/farpoint/alarms/', watched, 'alarm');
}

/**
 * Each name with `_` in place of characters that are invalid in topics: `Front` and `/front/image_raw` become `Front` and
 * `front_image_raw`.
 */
function topicsUnder(prefix: string, names: readonly string[], unnamed: string): string[] {
  const taken = new Set<string>();
  return names.map((each) => {
    const plain = each.replace(/^\/+/, '').replaceAll(/[^A-Za-z0-9_]/g, '_') || unnamed;
    const name = /^[0-9]/.test(plain) ? `_${plain}` : plain;
    let free = name;
    for (let n = 2; taken.has(free); n++) free = `${name}_${n}`;
    taken.add(free);
    return prefix + free;
  });
}
