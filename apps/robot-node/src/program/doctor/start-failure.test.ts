import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { RecordingError } from '@farpoint/recording';
import { StartFailure } from '@farpoint/service';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import { CaptureError } from '../../sense/capture/capture.ts';
import { openSource } from '../../sense/sources/open-source.ts';
import { robotOf } from '../options/testing/robot-of.ts';
import { startFailure } from './start-failure.ts';

const folder = useFolder();
const words = join(folder, 'words.txt');
writeFileSync(words, 'no cloud, no recording\n');
const missing = join(folder, 'missing');

describe('a robot that cannot start says what is wrong and what to do', () => {
  it.each([
    [['--source', 'pcd', '--path', missing], `pcd: ${missing} does not exist`, 'a PCD file'],
    [['--source', 'pcd', '--path', words], 'words.txt: PCD, line 1', 'a PCD file'],
    [['--source', 'rgbd', '--path', missing], `rgbd: ${missing} does not exist`, 'a folder of colour'],
    [['--source', 'rgbd', '--path', words], `rgbd: ${words} is not a folder`, 'a folder of colour'],
    [['--source', 'recording', '--path', missing], `recording: ${missing} does not exist`, 'an MCAP file'],
    [['--source', 'recording', '--path', words], 'neither MCAP nor a ROS 1 bag', 'an MCAP file'],
  ])('%j', async (argv, detail, remedy) => {
    const options = robotOf(argv);
    const error: unknown = await openSource(options.sensors[0]!.capture.source).catch(
      (cause: unknown) => cause,
    );
    // As the capture thread reports it.
    const failure = startFailure(options, new CaptureError(0, (error as Error).message, { cause: error }));
    expect(failure).toBeInstanceOf(StartFailure);
    const { message, remedy: said } = failure as StartFailure;
    expect(message).toContain(detail);
    expect(said).toContain(remedy);
  });

  it.each([
    [words, `${words} already exists`, 'name another file'],
    [join(missing, 'a.mcap'), `${missing} is not a folder`, 'create it'],
  ])('--record %s', (path, detail, remedy) => {
    const options = robotOf(['--record', path]);
    const failure = startFailure(options, new RecordingError('unreadable', 'what the system says'));
    expect(failure).toMatchObject({ message: detail, remedy: expect.stringContaining(remedy) as string });
  });

  it('an error that the doctor cannot explain stays as it is', () => {
    const error = new Error('strange');
    expect(startFailure(robotOf([]), error)).toBe(error);
    expect(startFailure(robotOf([]), new CaptureError(7, 'no such sensor'))).toBeInstanceOf(CaptureError);
  });
});
