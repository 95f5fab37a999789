/** Both catalogues, and that nothing that people read bypasses them. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { LANGUAGES } from '../ground/display/languages.ts';
import { type Leaf, leavesOf, said as saidOf } from '../testing/catalogue-leaves.ts';
import { german } from './de/catalogue.ts';
import { laterGerman } from './de/later-catalogue.ts';
import { english } from './en/catalogue.ts';
import { laterEnglish } from './en/later-catalogue.ts';

const ROOT = join(import.meta.dirname, '../..');
const SRC = join(ROOT, 'src');

const said = (leaf: Leaf): string => saidOf(leaf, 'N');

const of = { en: leavesOf({ ...english, ...laterEnglish }), de: leavesOf({ ...german, ...laterGerman }) };
const germanAt = new Map(of.de.map((leaf) => [leaf.path.join('.'), leaf]));

function sourcesOf(folder: string): string[] {
  return readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((file) => file.endsWith('.ts') && !/(^|\/)(testing|en|de)\/|\.test\.ts$/.test(file))
    .sort();
}

const sources = sourcesOf(SRC).map((file) => ({ file, text: readFileSync(join(SRC, file), 'utf8') }));
const pages = ['index.html', 'watch.html'].map((file) => ({
  file,
  text: readFileSync(join(ROOT, file), 'utf8'),
}));

/** Names, units, formats and marks that are the same in German, and texts that only order what they name. */
const ALIKE = new Set([
  'Position',
  'Position x',
  'Position y',
  'Median',
  'Dashboard',
  'Headset',
  'Token',
  'CSV',
  'Clip',
  'JSON Lines',
  '95 %',
  'N %, N',
  'max.',
  'N ×',
  'N, N, N',
  'N: N',
  'Version N',
  'N: STOP',
  'N (N s)',
  'Live',
  'live',
  'OK',
  'Topics',
  'ply',
  'pcd',
  'Auto',
  'N (N)',
  'STOP',
  'N %',
  'N % · N m/s',
  'N: N.',
  'N: N (N).',
  'N (offline)',
  'N, N',
  'N, N: N',
  'N m N',
  'N · N',
  'N  p95 N',
  'N N: N, N',
]);

describe('the catalogues', () => {
  test('have the same texts, of the same kind', () => {
    const shape = (leaves: readonly Leaf[]) =>
      leaves.map(({ path, text }) => `${path.join('.')} ${typeof text}`).sort();
    expect(shape(of.de)).toEqual(shape(of.en));
  });

  test('say nothing in German as in English, but for names and units', () => {
    const same = of.en.filter((leaf) => {
      const other = germanAt.get(leaf.path.join('.'));
      return other !== undefined && said(leaf) === said(other) && said(leaf) !== '' && !ALIKE.has(said(leaf));
    });
    const alike = new Set(of.en.map(said));
    expect([...ALIKE].filter((name) => !alike.has(name))).toEqual([]);
    expect(same.map((leaf) => `${leaf.path.join('.')}: ${said(leaf)}`)).toEqual([]);
  });

  test('have no text that nothing says', () => {
    const html = pages.map(({ text }) => text).join('\n');
    const speaking = sources.filter(({ text }) => /texts\(\)/i.test(text));
    const unused = of.en.filter(({ path }) => {
      const [area = '', ...keys] = path;
      const code = speaking.filter(({ text }) => new RegExp(`\\b${area}\\b`).test(text));
      const isRead = (key: string) =>
        /^\w+$/.test(key) &&
        code.some(({ text }) =>
          new RegExp(`\\.${key}\\b|[{,]\\s*${key}\\b(?=[^{}]*\\} = (texts|laterTexts|this))`).test(text),
        );
      // A table is read by a value, of the protocol for example.
      const isIndexed = (table: string) =>
        code.some(({ text }) => new RegExp(`\\b${table}\\[|\\.${table}[,; )\\n]|said\\[`).test(text));
      const [key = '', inTable] = keys;
      const isUsed = isRead(key) && (inTable === undefined || isRead(inTable) || isIndexed(key));
      return !isUsed && !html.includes(`"${path.join('.')}"`);
    });
    expect(unused.map(({ path }) => path.join('.'))).toEqual([]);
  });

  /**
   * Characters on the smallest screen that is supported. Chosen: the longest that layout.page.ts shows without cutting, which
   * holds them.
   */
  const SHORT = { pill: 60, button: 26, stop: 12 };
  const short: readonly (readonly [string, number])[] = [
    ...['unconfirmed', 'confirmed', 'undelivered'].map((key) => [`driving.stop.${key}`, SHORT.pill] as const),
    ...Object.keys(english.driving.holder).map((key) => [`driving.holder.${key}`, SHORT.pill] as const),
    ...['view', 'enterAr', 'dashboard', 'settings', 'disconnect', 'takeOver', 'latencyTest', 'talk'].map(
      (key) => [`page.${key}`, SHORT.button] as const,
    ),
    ...['holdToRelease', 'releaseAtRobot', 'askToDrive'].map((key) => [`page.${key}`, SHORT.button] as const),
    ...['handOver', 'giveUp', 'give', 'take', 'refuse', 'offer'].map(
      (key) => [`people.${key}`, SHORT.button] as const,
    ),
    ['stop.button.latched', SHORT.stop],
    ['stop.button.clear', SHORT.stop],
    ['headset.enterVr', SHORT.button],
  ];

  test.each(LANGUAGES)('keep pills and buttons short in %s', (language) => {
    const at = new Map(of[language].map((leaf) => [leaf.path.join('.'), leaf]));
    for (const [place, most] of short) {
      const leaf = at.get(place);
      expect(leaf, place).toBeDefined();
      expect(said(leaf as Leaf).length, place).toBeLessThanOrEqual(most);
    }
  });

  test('are addressed politely in German, and with German quotation marks', () => {
    for (const leaf of of.de) {
      const text = said(leaf);
      expect(text, leaf.path.join('.')).not.toMatch(/\b([Dd]u|[Dd]ein\w*|[Dd]ich|[Dd]ir)\b/);
      expect(text.includes('“') && !text.includes('„'), leaf.path.join('.')).toBe(false);
    }
  });
});

describe.each(pages)('$file', ({ text }) => {
  const named = [...text.matchAll(/ data-(text|keys|title|label|placeholder)="([^"]+)"/g)];

  test('names texts that are there from the beginning', () => {
    const texts = leavesOf(english);
    expect(named.length).toBeGreaterThan(5);
    for (const [, , place = ''] of named) {
      const leaf = texts.find(({ path }) => path.join('.') === place);
      expect(typeof leaf?.text, place).toBe('string');
    }
  });

  test('says nothing itself but names, degrees, and what it needs', () => {
    const body = text
      .replace(/<noscript>.*?<\/noscript>/gs, '')
      .replace(/<!--.*?-->/gs, '')
      .replace(/<[^>]*>/g, '\n');
    const words = body
      .split('\n')
      .map((line) => line.trim())
      .filter((line) => /\p{L}/u.test(line));
    const names = ['Farpoint', 'STOP', 'English', 'Deutsch'];
    expect(words.filter((word) => !names.includes(word))).toEqual([]);
    expect(text).not.toMatch(/ (title|aria-label|placeholder|alt)="/);
    expect(text).toContain('<noscript>');
  });
});

/** What looks like a sentence and is none that people read on the page: for developers, for the browser, or a name. */
const NOT_SAID: readonly RegExp[] = [
  /^[A-Z][a-z]+[A-Z]/, // Names of types and keys.
  /px system-ui/,
  /^legend overlay/, // Classes.
];

describe('the sources', () => {
  test('say nothing that is not in a catalogue', () => {
    const found = sources.flatMap(({ file, text }) =>
      text.split('\n').flatMap((line, i) => {
        const code = line.replace(/\/\/.*$/, '').trim();
        if (/^(\*|\/\*|import |\} from|export .* from)/.test(code)) return [];
        if (/console\.\w+\(|new (\w*Error|DOMException)\(|throw |Pick<|Omit</.test(code)) return [];
        const literals = [...code.matchAll(/'((?:[^'\\]|\\.)*)'|`((?:[^`\\]|\\.)*)`/g)].map(
          ([, plain, template]) => plain ?? template ?? '',
        );
        return literals
          .map((literal) => literal.replaceAll(/\$\{[^}]*\}/g, ''))
          .filter((literal) => /\p{Lu}\p{Ll}*[ …:].*\p{L}|\p{L}{3,} \p{L}{2,} \p{L}{2,}/u.test(literal))
          .filter((literal) => !NOT_SAID.some((allowed) => allowed.test(literal)))
          .map((literal) => `${file}:${i + 1}: ${literal}`);
      }),
    );
    expect(found).toEqual([]);
  });

  test('give no text to a title, a label or a button', () => {
    const set =
      /\.(title|ariaLabel|textContent|placeholder) = ['`][^'`]*\p{L}{2}|(setCustomValidity|quietButton|rowOf|sliderOf)\(['`][^'`]*\p{L}{2}/u;
    const found = sources.flatMap(({ file, text }) =>
      text
        .split('\n')
        .flatMap((line, i) =>
          set.test(line.replaceAll(/\$\{[^}]*\}/g, '')) ? [`${file}:${i + 1}: ${line.trim()}`] : [],
        ),
    );
    expect(found).toEqual([]);
  });
});
