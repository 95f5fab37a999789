import { afterEach, expect, test } from 'vitest';
import { bannerWords } from './banner-words.ts';
import { sessionFacts } from './facts.ts';
import { language, laterTexts, loadLaterTexts, speak, textAt, texts } from './language.ts';
import type { PageStats } from './page-stats.ts';
import { saveWords, sliderWords, tileFaultWords } from './settings-words.ts';

afterEach(() => speak('en'));

test('what is said follows the language that is spoken', async () => {
  expect([language(), texts().stop.title, textAt('page.settings')]).toEqual([
    'en',
    'Emergency stop',
    'Settings',
  ]);
  await speak('de');
  expect([language(), texts().stop.title, textAt('page.settings')]).toEqual([
    'de',
    'Nothalt',
    'Einstellungen',
  ]);
});

test('what parts say that are loaded later follows the language, too, and is there once', async () => {
  await loadLaterTexts();
  expect(laterTexts().help.groups.stop).toBe('Stop');
  await speak('de');
  expect(laterTexts().help.groups.stop).toBe('Anhalten');
});

test('a place without a text is a fault of the page', () => {
  for (const place of ['page.nothing', 'nothing.view', 'page', 'link.loss', 'stop.by'])
    expect(() => textAt(place)).toThrow(`no text ${place}`);
});

test('figures are found in another language, too: what is not heard is not live', async () => {
  await speak('de');
  const figures = {
    ...{ pointsPerFrame: 12_345, framesPerSecond: 10, bitsPerSecond: 3_210_000, lossRate: 0 },
    ...{ drawnOneOf: 1, remembered: null, minRttMs: 42, viewAgeMs: null, mtpMs: null },
  } as PageStats;
  const session = {
    ...{ heard: false, pointsHeard: false, drives: true, name: 'Rover', telemetry: null, maxLinear: 1 },
    ...({ estop: { type: 'estop', latched: false }, readings: [], figures } as const),
  } as const;
  const shownOf = (heard: boolean, wanted: string) =>
    sessionFacts({ ...session, heard, pointsHeard: heard }).find(({ name }) => name === wanted)?.value;
  expect(shownOf(false, 'Roboter')).toBe('Rover');
  expect(shownOf(false, 'Punkte')).toBe('–');
  expect(shownOf(true, 'Punkte')).toBe('12.345 × 10/s');
  expect(shownOf(true, 'Datenrate')).toBe('3,2 Mbit/s');
});

test('the banner of a lost link is in the language that is spoken', async () => {
  await speak('de');
  const banner = bannerWords({
    ...{ phase: 'live', silence: 'lost', interrupted: true, signaling: 'ready', online: true },
    ...{ robotListed: true, robotId: 'r', lastLoss: null, maxOperators: null, lossDetail: null },
    ...{ gripped: true, gripLost: null, takenOverBy: null },
  } as const);
  expect(banner?.title).toBe('Der Roboter antwortet nicht');
  expect(banner?.text).toMatch(/hält von selbst an.*Lassen Sie den Griff los\.$/);
});

test('the settings’ button says whether the page connects anew, or is only loaded again', () => {
  const said = [
    { reconnects: false, reloads: false },
    { reconnects: false, reloads: true },
    { reconnects: true, reloads: true },
  ].map(saveWords);
  expect(said).toEqual(['Save', 'Save and reload', 'Save and reconnect']);
});

test('sliders and map addresses are described', () => {
  expect([sliderWords.pointScale?.(1.5), sliderWords.vignette?.(0)]).toEqual(['1.50 ×', 'none']);
  expect(tileFaultWords('too-long')).toContain('512');
  expect(tileFaultWords('misses-number')).toContain('{y}');
});
