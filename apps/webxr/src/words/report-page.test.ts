import { afterEach, describe, expect, test } from 'vitest';
import { SessionRecord } from '../ground/report/session-record.ts';
import { speak } from './language.ts';
import { reportPage } from './report-page.ts';
import { durationText, sessionText } from './session-text.ts';

function record(name = 'Rover', operator = 'Ann'): SessionRecord {
  const made = new SessionRecord({
    robot: { id: 'rover-1', name },
    operator: { name: operator, role: 'drive' },
    epochMs: Date.UTC(2026, 10, 30, 11, 12, 5),
    nowMs: 0,
    maxLinearMps: 1,
  });
  made.onEvent({ kind: 'command-refused', reason: 'stale' }, 0, 12);
  const stop = { kind: 'stop', by: 'operator', heldBy: [], start: null, already: false } as const;
  made.onEvent({ ...stop, heldBy: [], name: operator }, 0, 1);
  made.onEvent({ kind: 'latency', mtpMs: 88.25, firstMs: 70 }, 0, 1);
  made.onSample({
    bytesReceived: 2_500_000,
    packetsReceived: 990,
    packetsLost: 10,
    bitsPerSecond: 8_123_000,
    rttMs: 40,
    framesPerSecond: 9.5,
    pointsPerSecond: 200_000,
    displayFramesPerSecond: 60,
    viewAgeMs: 120,
  });
  return made;
}

/** The rows of the page, as text. */
function rows(page: string): string[] {
  return [...page.matchAll(/<tr>(.*?)<\/tr>/g)].map(([, row]) =>
    (row ?? '').replaceAll(/<\/t[hd]>/g, '|').replaceAll(/<[^>]*>/g, ''),
  );
}

afterEach(() => speak('en'));

describe('the page of a session’s report', () => {
  test('has its figures', () => {
    const ended = record();
    ended.end('robot-stopped', 3_723_000);
    const found = rows(reportPage(ended.report(0), 'en'));
    expect(found).toEqual(
      expect.arrayContaining([
        'Robot|Rover (rover-1)|',
        'Operator|Ann (drive)|',
        'Began|2026-11-30 11:12:05 UTC|',
        'Ended|2026-11-30 12:14:08 UTC|',
        'Duration|1:02:03|',
        'Reason of the end|the robot was shut down|',
        'STOP by others|1|',
        'STOP by Ann|1|',
        'Commands refused|12|',
        'Refused: too old on arrival|12|',
        'Packets lost|1.00 %|',
        'Received|2.5 MB|',
        'Motion to photon|88.3|88.3|88.3|88.3|1|',
        'Cloud: capture to screen|–|–|–|–|0|',
      ]),
    );
  });

  test('of a session that lasts says so, and speaks the page’s language', async () => {
    expect(rows(reportPage(record().report(0), 'en'))).toContain('Ended|still running|');
    await speak('de');
    const page = reportPage(record().report(0), 'de');
    expect(page).toContain('<html lang="de">');
    expect(rows(page)).toContain('Ende|läuft noch|');
    expect(rows(page)).toContain('Abgelehnt: zu alt angekommen|12|');
  });

  test('is a file of its own: no scripts, nothing that is fetched, and every name is text', () => {
    const hostile = `<script src="//evil">alert(1)</script>"'&<img onerror=x>`;
    const page = reportPage(record(hostile, hostile).report(0), '"><script>');
    const tags = new Set([...page.matchAll(/<\/?([a-z0-9]+)/gi)].map(([, name]) => name));
    expect([...tags].sort()).toEqual(
      [
        'body',
        'h1',
        'h2',
        'head',
        'html',
        'main',
        'meta',
        'section',
        'style',
        'table',
        'tbody',
        'td',
        'th',
      ].concat(['thead', 'title', 'tr']),
    );
    expect(page).not.toMatch(/<[^>]*\s(src|href|on\w+)\s*=/i);
    expect(page).toContain(`content="default-src 'none'; style-src 'unsafe-inline'"`);
    expect(page).toContain('&lt;script src=&quot;//evil&quot;&gt;');
    expect(page).toContain('&#39;&amp;&lt;img');
  });
});

test('durations and sessions in a few words', () => {
  expect([0, 59.6, 61, 3599, 3600].map(durationText)).toEqual(['0:00', '1:00', '1:01', '59:59', '1:00:00']);
  const lasting = record();
  expect(sessionText(lasting.report(0))).toMatch(/^Rover, .+, still running$/);
  lasting.end('left', 61_000);
  expect(sessionText(lasting.report(0))).toMatch(/^Rover, .+, 1:01$/);
});
