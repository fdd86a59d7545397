#!/usr/bin/python3
"""Writes a .db3 file as rosbag2's SQLite storage does, schema version 3 (Humble): make_database.py
OUT.db3 < lines of JSON, each [topic, type, time in ns, base64 of the message]."""
import base64
import json
import os
import sqlite3
import sys

if os.path.exists(sys.argv[1]):
    os.remove(sys.argv[1])
database = sqlite3.connect(sys.argv[1])
database.executescript("""
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
    serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
    data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES(3, 'humble');
""")
topics = {}
for line in sys.stdin:
    topic, kind, time, data = json.loads(line)
    if topic not in topics:
        topics[topic] = len(topics) + 1
        database.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", (topics[topic], topic, kind))
    database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                     (topics[topic], int(time), base64.b64decode(data)))
database.commit()
