/** Checks the files that the robot shares with a camera, wheels or a recording: permissions and free space. */
import { accessSync, constants, type Stats, statfsSync, statSync } from 'node:fs';
import { dirname } from 'node:path';
import {
  cloudFile,
  isAvailable,
  lockHolder,
  referenceFiles,
  type TrustedOwner,
} from '@farpoint/shared-memory';
import type { SinkOptions } from '../../motion/drive/open-sink.ts';
import type { SourceOptions } from '../../sense/sources/open-source.ts';
import type { RecordingOptions } from '../../tell/recording-options.ts';
import type { RobotOptions } from '../robot-configuration.ts';
import { fleetingState, placeText, STATE_REMEDY } from '../state-place.ts';
import { fail, ok, type Result, warn } from './finding.ts';
import { megabytes } from './host.ts';

/** Shared memory without a word, bytes. Chosen: the 64 MiB that Docker gives a container just pass. */
const EASY_SHARED_BYTES = 64e6;
/** Room for recordings without a word, bytes. Chosen: some half an hour at 24 Mbit/s. */
const EASY_RECORDING_BYTES = 5e9;

/**
 * Checks the addon, the folder, and the files of programs that are already running.
 *
 * @param robotRuns a running robot writes the velocities
 */
export function checkSharedMemory(source: SourceOptions, sink: SinkOptions, robotRuns = false): Result[] {
  const folder = source.kind === 'shm' ? source.folder : sink.kind === 'shm' ? sink.folder : null;
  if (folder === null) return [];
  if (!isAvailable())
    return [
      fail(
        'the addon is not built',
        'install a C compiler, make and Python 3, then run `pnpm build:native` (Linux only)',
      ),
    ];
  const folderStats = stats(folder);
  if (folderStats === null || !folderStats.isDirectory())
    return [
      fail(
        `${folder} is not a folder`,
        'set source.shmFolder; /dev/shm is usual, in a container with `--ipc=host` or a volume',
      ),
    ];
  const results = [
    checkRoom(
      folder,
      EASY_SHARED_BYTES,
      'a container has 64 MB by default: use `--ipc=host` or `--shm-size`',
    ),
  ];
  const files = referenceFiles(folder);
  if (source.kind === 'shm') {
    const wanted = source.layout === 'reference' ? [files.cloud, files.flags] : [cloudFile(folder)];
    results.push(...wanted.flatMap((file) => checkFile(file, source.layout === 'reference', source.owner)));
  }
  if (sink.kind === 'shm') {
    results.push(...[files.control, files.busy].flatMap((file) => checkFile(file, true, sink.owner)));
    const writer = robotRuns ? null : lockHolder(files.control);
    if (writer !== null)
      results.push(
        fail(
          `${files.control} is written by another program (process ${writer})`,
          'end that program, or give this robot a folder of its own: source.shmFolder',
        ),
      );
    if (stats(files.control) === null && !may(folder, constants.W_OK))
      results.push(fail(`${folder} is not writable`, 'run the robot as a user who may create files there'));
  }
  return results;
}

/** Checks a file that the robot creates at its start: a missing file is no fault. */
function checkFile(path: string, write: boolean, trusted: TrustedOwner | undefined): Result[] {
  const found = stats(path);
  if (found === null) return [];
  const owner = `of user ${found.uid}, mode ${(found.mode & 0o777).toString(8).padStart(4, '0')}`;
  if (!found.isFile()) return [fail(`${path} is not a regular file`, 'remove it')];
  if (trusted !== 'any' && ![process.geteuid?.(), 0, trusted].includes(found.uid))
    return [
      fail(
        `${path} (${owner}) is of another user and is refused`,
        `run both programs as the same user, or set source.shmOwner: ${found.uid}`,
      ),
    ];
  if ((found.mode & 0o002) !== 0)
    return [
      fail(
        `${path} (${owner}) is writable by everybody and is refused`,
        'its program should create it with mode 0600, or 0660 for a group',
      ),
    ];
  if (!may(path, constants.R_OK | (write ? constants.W_OK : 0)))
    return [
      fail(
        `${path} (${owner}) is not ${write ? 'writable' : 'readable'} for user ${process.getuid?.()}`,
        'run both programs as the same user, or give the file to a group that both are in (0660)',
      ),
    ];
  return [ok(`${path}, ${owner}`)];
}

/** The file that is written, and the folder of operators' recordings. @param record `undefined` if nothing is recorded */
export function checkRecording(record: Pick<RecordingOptions, 'path' | 'folder'> | undefined): Result[] {
  if (record === undefined) return [];
  const { path, folder } = record;
  if (path !== null && stats(path) !== null)
    return [fail(`${path} already exists`, 'name another file: recordings are never overwritten')];
  return [
    ...(path === null ? [] : checkRecordingFolder(dirname(path), 'recording.file')),
    ...(folder === null ? [] : checkRecordingFolder(folder.path, 'recording.folder')),
  ];
}

function checkRecordingFolder(folder: string, key: string): Result[] {
  if (!(stats(folder)?.isDirectory() ?? false))
    return [fail(`${folder} is not a folder`, `create it, or set ${key}`)];
  if (!may(folder, constants.W_OK))
    return [fail(`${folder} is not writable`, 'make the robot’s user its owner')];
  return [
    checkRoom(
      folder,
      EASY_RECORDING_BYTES,
      'clouds take about 20 to 40 MB a second: free some space, or set recording.max and recording.clouds',
    ),
  ];
}

function checkRoom(folder: string, easyBytes: number, remedy: string): Result {
  const { bavail, bsize } = statfsSync(folder);
  const what = `${megabytes(bavail * bsize)} free in ${folder}`;
  return bavail * bsize < easyBytes ? warn(what, remedy) : ok(what);
}

function stats(path: string): Stats | null {
  return statSync(path, { throwIfNoEntry: false }) ?? null;
}

function may(path: string, mode: number): boolean {
  try {
    accessSync(path, mode);
    return true;
  } catch {
    return false;
  }
}

/** Checks whether the robot will remember its emergency stop, its key and revoked grants. */
export function checkState(options: Pick<RobotOptions, 'stateFolder' | 'robotKey' | 'audit'>): Result[] {
  const places = fleetingState(options);
  if (places.length === 0) return [ok(`${options.stateFolder} is kept`)];
  return places.map((place) => warn(placeText(place), STATE_REMEDY));
}
