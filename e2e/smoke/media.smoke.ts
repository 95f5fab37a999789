/** Real encoders at the robot and real decoders in the browser. */
import { toneShare } from '@farpoint/sound/testing';
import type { Page } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { hasSound, hasVideo, NEEDS_SOUND, NEEDS_VIDEO } from '../src/robots.ts';
import { readShownVideos } from '../src/shown-videos.ts';
import { expect, test } from '../src/smoke-test.ts';
import { AUDIO_RATE, VOICE_HZ } from '../src/voice.ts';

const CANVAS = '160x90';
const videos = (page: Page) => page.evaluate(() => window.farpoint.videos());
const sound = (page: Page) => page.evaluate(() => window.farpoint.sound());

async function seesMore(page: Page, codec: string): Promise<void> {
  const frames = async () => (await videos(page))[0]?.frames ?? 0;
  await expect.poll(async () => (await videos(page))[0]?.codec).toBe(codec);
  const before = await frames();
  await expect.poll(frames).toBeGreaterThan(before + 5);
  expect((await videos(page))[0]?.fault).toBeNull();
}

/** As a Chromium that was built without H.264. */
function withoutH264(page: Page): Promise<unknown> {
  return page.addInitScript(() => {
    const { prototype } = RTCPeerConnection;
    const apply = prototype.setRemoteDescription as (description: RTCSessionDescriptionInit) => Promise<void>;
    prototype.setRemoteDescription = function (
      this: RTCPeerConnection,
      description: RTCSessionDescriptionInit,
    ) {
      const sections = (description.sdp ?? '').split(/^(?=m=)/m).map((section) => {
        const type = /^a=rtpmap:(\d+) H264\//m.exec(section)?.[1];
        if (type === undefined) return section;
        const others = section.split('\r\n').filter((line) => !line.match(`^a=[a-z-]+:${type} `));
        const left = others.join('\r\n').replace(new RegExp(`^(m=.*) ${type}(?= |\\r)`), '$1');
        // A line of H.264 only is one that it cannot decode.
        return /^m=\S+ \d+ \S+ /.test(left) ? left : section.replaceAll('H264/', 'none/');
      });
      return apply.call(this, { type: description.type ?? 'offer', sdp: sections.join('') });
    } as typeof prototype.setRemoteDescription;
  });
}

test('two cameras are shown in step, each picture with its own time; one that is hidden is not encoded', async ({
  page,
  shared,
}, testInfo) => {
  test.skip(!hasVideo, NEEDS_VIDEO);
  const { spec } = await shared.media();
  const options = { robot: spec.id, canvas: CANVAS, barcode: '1' } as const;
  const operator = await OperatorPage.open(page, shared.stack.webUrl, options);
  await operator.expectPoints();
  await expect
    .poll(
      async () => {
        const { videos: shown } = await readShownVideos(page, [0, 1]);
        // What the page knows is what is drawn.
        for (const { knownMs, drawnMs } of shown)
          if (drawnMs !== null) expect(drawnMs).toBeCloseTo(knownMs, 0);
        const [front, rear] = shown.map(({ drawnMs }) => drawnMs ?? Number.NaN);
        return Math.round(Math.abs((front ?? Number.NaN) - (rear ?? Number.NaN)));
      },
      { message: 'from the older to the newer that are shown together, ms' },
    )
    .toBe(0);
  await operator.picture(testInfo, 'videos');

  await page.getByRole('button', { name: 'Hide Front' }).click();
  const encoded = () => shared.metric(spec.id, 'video_frames_total{camera="Front"}');
  await expect
    .poll(async () => {
      const before = await encoded();
      await operator.expectFrames(5);
      return (await encoded()) - before;
    })
    .toBe(0);
  const { frames = 0 } = (await videos(page))[0] ?? {};
  await page.getByRole('button', { name: 'Show Front' }).click();
  await expect.poll(async () => (await videos(page))[0]?.frames ?? 0).toBeGreaterThan(frames);
});

test('a camera changes its codec for somebody without H.264, under way, in all ways to receive it', async ({
  page,
  context,
  shared,
}) => {
  test.skip(!hasVideo, NEEDS_VIDEO);
  const { spec } = await shared.media();
  const options = { robot: spec.id, canvas: CANVAS };
  for (const video of ['track', 'webcodecs', 'native'] as const) {
    const operator = await OperatorPage.open(page, shared.stack.webUrl, { ...options, video });
    await operator.expectPoints();
    await seesMore(page, 'H264');
    expect((await operator.stats()).videos.receiver).toBe(video);

    const other = await context.newPage();
    await withoutH264(other);
    const second = await OperatorPage.open(other, shared.stack.webUrl, options);
    await second.expectState('session', 'live');
    await seesMore(other, 'VP8');
    await page.bringToFront();
    await seesMore(page, 'VP8');
    // The camera that has H.264 only is one that the second cannot see, and that goes on for the first.
    expect((await videos(other))[1]).toMatchObject({ codec: 'H264', frames: 0 });
    expect((await videos(other))[1]?.fault).toMatch(/cannot decode|does not decode/);
    expect((await videos(page))[1]).toMatchObject({ codec: 'H264', fault: null });
    await other.close();
    await seesMore(page, 'H264');
  }
});

test('the robot is heard while Sound is on; the driver’s voice comes out of it while a key or a button is held', async ({
  page,
  shared,
}) => {
  test.skip(!hasSound, NEEDS_SOUND);
  const { spec, heard } = await shared.media();
  const operator = await OperatorPage.open(page, shared.stack.webUrl, { robot: spec.id, canvas: CANVAS });
  await operator.expectPoints();
  const packets = await shared.metric(spec.id, 'sound_packets_total');
  const expectTone = () =>
    expect.poll(async () => Math.abs(((await sound(page)).peakHz ?? 0) - 600)).toBeLessThan(12);
  await page.getByRole('button', { name: 'Sound', exact: true }).click();
  await expectTone();
  expect(await shared.metric(spec.id, 'sound_packets_total')).toBeGreaterThan(packets);

  // Only the driver's voice is played.
  await page.keyboard.down('m');
  await expect(page.locator('#talk-state')).toContainText('only the driver');
  await page.keyboard.up('m');
  expect(heard()).toHaveLength(0);
  await page.evaluate(() => window.farpoint.requestLease());
  await operator.expectState('holder', 'you');
  await page.keyboard.down('m');
  await expect(page.locator('#talk-state')).toHaveText('The robot hears you');
  // The tone comes and goes, browsers shape what they take for speech, and a busy machine leaves gaps.
  const tones = () => {
    const played = heard();
    const length = AUDIO_RATE / 16;
    return Array.from({ length: Math.floor(played.length / length) }, (_, i) =>
      toneShare(played.subarray(i * length, (i + 1) * length), VOICE_HZ, AUDIO_RATE),
    ).filter((share) => share > 0.7).length;
  };
  await expect.poll(tones).toBeGreaterThan(3);
  // A page that loses the focus hears no key that is let go.
  await page.evaluate(() => window.dispatchEvent(new Event('blur')));
  expect((await sound(page)).sending).toBe(false);
  await expect.poll(() => shared.metric(spec.id, 'voice_open')).toBe(0);
  await page.keyboard.up('m');
  await page.locator('#talk').hover();
  await page.mouse.down();
  await expect.poll(async () => (await sound(page)).said.state).toBe('live');
  await page.mouse.up();
  expect((await sound(page)).sending).toBe(false);
  await expectTone();
  await page.getByRole('button', { name: 'Sound', exact: true }).click();
  await expect.poll(() => shared.metric(spec.id, 'sound_bits_per_second')).toBe(0);
});
