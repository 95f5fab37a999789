/** Finds the definitions of messages that are not ROS's own on this machine. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import {
  definitionsFromFiles,
  definitionsOf,
  type ReadMessageFile,
  RosFault,
  type TopicEntry,
} from '@farpoint/ros';

/** The package folders of the ROS 2 installation that is sourced. */
export function sourcedFolders(env: Readonly<Record<string, string | undefined>>): string[] {
  const prefixes = (env.AMENT_PREFIX_PATH ?? '').split(':').filter((prefix) => prefix !== '');
  return prefixes.map((prefix) => join(prefix, 'share'));
}

/** Reads `<folder>/<package>/msg/<name>.msg` from the first folder that has it. */
export function readFrom(folders: readonly string[]): ReadMessageFile {
  return (packageName, name) => {
    for (const folder of folders) {
      try {
        return readFileSync(join(folder, packageName, 'msg', `${name}.msg`), 'utf8');
      } catch {
        // The next folder may have it.
      }
    }
    return null;
  };
}

/**
 * Adds the type definitions to topics whose types are not ROS's own.
 *
 * @throws {RosFault} `unsupported`, naming the topic and the file that is missing or wrong
 */
export function describeTopics(topics: readonly TopicEntry[], read: ReadMessageFile): TopicEntry[] {
  return topics.map((entry) => {
    if (definitionsOf(2, entry.type) !== null) return entry;
    try {
      return { ...entry, definitions: definitionsFromFiles(entry.type, read) };
    } catch (error) {
      throw RosFault.of(error, entry.topic);
    }
  });
}
