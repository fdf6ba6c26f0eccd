// SPDX-License-Identifier: GPL-2.0-or-later
#include "earthquakes.h"
#include "event_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "catalogue_input.h"
#include "files/file_error.h"
#include "event_time.h"
#include "text_bytes.h"
#include "unit_files.h"

using namespace LSM;
using namespace LSM::postproc;
using unit::contains;
using unit::expect_error;
using unit::spill;

namespace {

// The same four events in each format: Northridge, an aftershock, a quarry blast, and an earlier
// event. ComCat lists the newest first.
const std::string csv =
    "time,latitude,longitude,depth,mag,magType,nst,id,updated,place,type\n"
    "1994-01-17T12:31:58.12Z,34.275,-118.493,5.3,5.89,mw,,ci3,2016,\"1km NNE of Granada Hills, "
    "CA\",earthquake\n"
    "1994-01-17T12:30:55.39Z,34.213,-118.537,18.2,6.7,mw,,ci1,2016,\"1km NNW of Reseda, "
    "\"\"CA\"\"\",earthquake\n"
    "1994-01-16T20:00:00.00Z,34.8,-116.7,0,1.5,mc,,ci4,2016,\"near Barstow, CA\",quarry blast\n"
    "1994-01-15T00:00:00.00Z,33.5,-116.5,5,2.01,mc,,ci5,2016,\"Anza, CA\",earthquake\n";
const std::string scedc =
    "#YYY/MM/DD HH:mm:SS.ss ET GT MAG  M    LAT     LON     DEPTH Q  EVID      NPH NGRM\n"
    "1994/01/15 00:00:00.00 eq  l 2.01 c    33.500 -116.500   5.0 A  5          10   20\n"
    "1994/01/16 20:00:00.00 qb  l 1.50 c    34.800 -116.700   0.0 A  4          10   20\n"
    "1994/01/17 12:30:55.39 eq  l 6.70 w    34.213 -118.537  18.2 A  1         100  200\n"
    "1994/01/17 12:31:58.12 eq  l 5.89 w    34.275 -118.493   5.3 A  3          50   60\n"
    "\n# Number of rows returned (1): 4\n";
const std::string zmap =
    "-116.500\t33.500\t1994.0383562\t1\t15\t2.01\t5.0\t0\t0\t0\n"
    "-118.537 34.213 1994 01 17 6.7 18.2 12 30 55.39\n"
    "-118.493 34.275 1994 1 17 5.89 5.3 12 31 58.12\n";
const std::string quakeml =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<q:quakeml xmlns=\"http://quakeml.org/xmlns/bed/1.2\" "
    "xmlns:q=\"http://quakeml.org/xmlns/quakeml/1.2\">\n"
    "<eventParameters publicID=\"quakeml:x\">\n"
    "<event publicID=\"quakeml:1\"><type>earthquake</type>\n"
    " <preferredOriginID>quakeml:o2</preferredOriginID>\n"
    " <preferredMagnitudeID>quakeml:m2</preferredMagnitudeID>\n"
    " <origin publicID=\"quakeml:o1\"><time><value>1900-01-01T00:00:00Z</value></time>"
    "<latitude><value>0</value></latitude><longitude><value>0</value></longitude></origin>\n"
    " <origin publicID=\"quakeml:o2\"><time><value>1994-01-17T12:30:55.390000Z</value></time>"
    "<latitude><value>34.213</value></latitude><longitude><value>-118.537</value></longitude>"
    "</origin>\n"
    " <magnitude publicID=\"quakeml:m1\"><mag><value>6.4</value></mag></magnitude>\n"
    " <magnitude publicID=\"quakeml:m2\"><mag><value>6.7</value></mag></magnitude>\n"
    "</event>\n"
    "<event publicID=\"quakeml:3\"><origin "
    "publicID=\"quakeml:o3\"><time><value>1994-01-17T12:31:58.12</value></time>"
    "<latitude><value>34.275</value></latitude><longitude><value>-118.493</value></longitude>"
    "</origin><magnitude><mag><value>5.89</value></mag></magnitude></event>\n"
    "<event publicID=\"quakeml:4\"><type>quarry blast</type><origin>"
    "<time><value>1994-01-16T20:00:00Z</value></time><latitude><value>34.8</value></latitude>"
    "<longitude><value>-116.7</value></longitude></origin></event>\n"
    "<event publicID=\"quakeml:5\"><type>earthquake</type><origin>"
    "<time><value>1994-01-15T00:00:00Z</value></time><latitude><value>33.5</value></latitude>"
    "<longitude><value>-116.5</value></longitude></origin>"
    "<magnitude><mag><value>2.01</value></mag></magnitude></event>\n"
    "</eventParameters></q:quakeml>\n";

EarthquakeList read(const std::string &content, bool lenient = false) {
  unit::TextBytes bytes(content, "file");
  return read_earthquakes(bytes, detect_format(content), lenient);
}

void refused(const std::string &content, const std::string &says, const std::string &format = "") {
  unit::TextBytes bytes(content, "file");
  const std::string read_as = format.empty() ? detect_format(content) : format;
  expect_error<FileError>([&] { read_earthquakes(bytes, read_as, false); }, says);
}

TEST(Earthquakes, AllFormatsHoldTheSameEvents) {
  const double seconds = 86400.0, day = 8779.0;  // 1994-01-14, days after 1970-01-01
  for (const std::string &content : {csv, scedc, zmap, quakeml}) {
    const EarthquakeList list = read(content);
    ASSERT_EQ(list.events.size(), 3u) << content;
    EXPECT_NEAR((list.events[0].time - day - 1) * seconds, 0.0, 1e-4);
    EXPECT_NEAR((list.events[1].time - day - 3) * seconds, 12 * 3600 + 30 * 60 + 55.39, 1e-4);
    EXPECT_NEAR((list.events[2].time - day - 3) * seconds, 12 * 3600 + 31 * 60 + 58.12, 1e-4);
    EXPECT_EQ(list.events[1].magnitude, 6.7);
    EXPECT_EQ(list.events[1].latitude, 34.213);
    EXPECT_EQ(list.events[1].longitude, -118.537);
    if (&content != &zmap && content != zmap) {
      ASSERT_EQ(list.others.size(), 1u);
      EXPECT_EQ(list.others.begin()->second, 1);
    }
  }
}

TEST(Earthquakes, DatesAndTimes) {
  EXPECT_EQ(parse_date("1970-01-01"), 0.0);
  EXPECT_EQ(parse_date("2000-03-01T06:00"), 11017.25);
  EXPECT_EQ(parse_date("2000/03/01 06:00:00.0Z"), 11017.25);
  EXPECT_EQ(parse_date("2000-03-01T06:00:00+06:00"), 11017.0);
  EXPECT_EQ(parse_date("2000-02-29T18:00:00-0600"), 11017.0);
  EXPECT_EQ(parse_date("2016-12-31T23:59:60Z"), 17167.0);  // a leap second
  EXPECT_NEAR(*parse_date("1999-10-17T23:24:60.99Z"),
              10881.0 + (23 * 60 + 25) / 1440.0 + 0.99 / 86400, 1e-9);
  for (const char *bad : {"", "2000", "2000-13-01", "2001-02-29", "2000-03-01T25:00",
                          "2000-03-01T06", "2000-03-01T06:61", "2000-03-01T06:00:91",
                          "2000-03-01T06:00x", "03/04/2000", "13/13/2000", "3 Mar 00", "0099-03-01",
                          "2000-03-01T06:00 JST", "2000-03-01T13:00 PM", "2000301", "yesterday"})
    EXPECT_FALSE(parse_date(bad)) << bad;
  for (const char *other : {"2000-3-1 6:00", "2000.03.01 06:00:00", "20000301060000",
                            "200003010600", "20000301T060000Z", "2000-03-01 06:00:00 UTC",
                            "1 Mar 2000 06:00", "March 1, 2000 6:00:00 AM", "2000-03-01 05:60:00",
                            "01-Mar-2000 06:00", "2000-03-01T05:59:59,999999999"}) {
    ASSERT_TRUE(parse_date(other)) << other;
    EXPECT_NEAR(*parse_date(other), 11017.25, 1e-9) << other;
  }
  EXPECT_EQ(date_text(11017.25), "2000-03-01T06:00Z");
}

TEST(Earthquakes, WhatCannotBeReadIsNamed) {
  refused("time,latitude,longitude,mag\n1994-01-17T12:30:55Z,34,-118,6.7\nmonday,34,-118,2\n",
          "file:3: time is 'monday', expected a date and time such as");
  refused("time,latitude,longitude,mag\n1994-01-17T12:30:55Z,34,-118\n",
          "file:2: 3 fields, expected 4");
  refused("time,latitude,longitude,mag\n1994-01-17T12:30:55Z,north,-118,3\n",
          "file:2: latitude is 'north', expected a number");
  refused("time,latitude,longitude,mag\n1994-01-17T12:30:55Z,94,-118,3\n",
          "file:2: latitude is '94', expected a number");
  refused("time,latitude,longitude,mag\n1994-01-17T12:30:55Z,34,-118,large\n",
          "file:2: magnitude is 'large', expected a number");
  refused("1994/01/17 12:30:55.39 eq l 6.7\n", "file:1: 5 fields, expected date, time, event type");
  refused(zmap + "-118 34 1994 13 1 2 5 0 0 0\n", "file:4: no event of ZMAP, expected longitude");
  refused("<quakeml>\n<eventParameters>\n<event>\n</eventParameters></quakeml>\n",
          "expected QuakeML");
  refused("<quakeml/>\n", "file: no element eventParameters, expected QuakeML");
  refused("<quakeml><eventParameters>\n<event><origin/></event>\n</eventParameters></quakeml>\n",
          "file:2: time is '', expected a date and time");
  refused("a,b\n1,2\n", "file:1: column names without time, latitude, longitude and mag", "csv");
  const EarthquakeList list = read(csv + "nonsense\nmore\n", true);
  EXPECT_EQ(list.events.size(), 3u);
  EXPECT_EQ(list.bad_lines, 2);
  EXPECT_TRUE(contains(list.first_problem, "file:6: 1 fields, expected 11"));
}

// A type may be the type of the magnitude (ISC), a code, or unknown: only what is known to be
// something else is left out.
TEST(Earthquakes, OnlyWhatIsKnownToBeNoEarthquakeIsLeftOut) {
  const auto file_of = [](const std::vector<std::string> &types) {
    std::string text = "date,time,lat,lon,type,mag\n";
    for (const std::string &type : types)
      text += "2011-03-11,05:46:23.20, 38.2963, 142.4980," + type + ", 9.1\n";
    return text;
  };
  std::vector<std::string_view> names;
  text::split(
      "MW,mb,ML,Mi,,earthquake,Earthquake,ke,se,fe,de,ki,si,uk,kr,null,not reported,other event,"
      "unknown,induced earthquake,induced or triggered event,rock burst,eq,eql,le,re,ts,lp,VT,vt,"
      "volcano-tectonic,LP,HB",
      names);
  const std::vector<std::string> kept(names.begin(), names.end());
  EXPECT_EQ(read(file_of(kept)).events.size(), kept.size());
  for (const char *const no_earthquake :
       {"quarry blast", "Quarry_Blast", "explosion", "mining explosion", "nuclear explosion", "qb",
        "km", "sm", "kn", "kx", "sn", "sonic boom", "landslide", "mine collapse", "ice quake",
        "duplicate earthquake", "not existing", "volcanic eruption", "meteorite"}) {
    const EarthquakeList list = read(file_of({"eq", no_earthquake}));
    EXPECT_EQ(list.events.size(), 1u) << no_earthquake;
    EXPECT_EQ(list.others.count(no_earthquake), 1u) << no_earthquake;
  }
  const std::string most = file_of({"qb", "eq", "qb", "explosion"});
  refused(most,
          "file: 3 of 4 events are no earthquakes (1 of type 'explosion', 2 of type 'qb'), "
          "expected less than half");
  EXPECT_EQ(read(most, true).events.size(), 1u);
}

TEST(Earthquakes, QuakeMlWithValuesOnLinesOfTheirOwn) {
  std::string text;
  for (const char c : quakeml) {
    if (c == '<' && text.back() != '>' && text.back() != '\n') text += "\n   ";
    text += c;
    if (c == '>') text += "\r\n\t ";
  }
  text.replace(text.find("quakeml:m2\""), 11, " \n quakeml:m2 \"");
  const EarthquakeList list = read(text), plain = read(quakeml);
  ASSERT_EQ(list.events.size(), 3u);
  EXPECT_EQ(list.others, plain.others);
  EXPECT_EQ(list.not_preferred, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(list.events[i].time, plain.events[i].time);
    EXPECT_EQ(list.events[i].magnitude, plain.events[i].magnitude);
  }
  text.replace(text.find("quakeml:m2"), 10, "quakeml:m3");
  EXPECT_EQ(read(text).events[1].magnitude, 6.4);
  EXPECT_EQ(read(text).not_preferred, 1);
}

TEST(Earthquakes, MissingValues) {
  for (const char *const missing : {"", "nan", "NaN", "null", "NULL", "None", "NA", "--", "-"}) {
    const std::string none = missing;
    const EarthquakeList list =
        read("time,latitude,longitude,depth,mag\n1994-01-17T12:30:55Z,34,-118,1," + none +
             "\n1994-01-18,34,-118," + none + ",3.1\n1994-01-19," + none + "," + none + ",1,3.2\n");
    EXPECT_EQ(list.without_magnitude, 1) << none;
    ASSERT_EQ(list.events.size(), 2u) << none;
    EXPECT_TRUE(std::isnan(list.events[1].latitude)) << none;
    EXPECT_FALSE(parse_region("-180/180/-90/90").contains(list.events[1])) << none;
  }
  const EarthquakeList list = read(
      "-116.5\t33.5\t1994.04\t1\t15\t2.01\tNaN\t0\t0\t0\n"
      "-116.5\t33.5\t1994.04\t1\t16\tNaN\tNaN\t0\t0\t0\n"
      "NaN\tNaN\t1994.04\t1\t17\t2.02\tNaN\tNaN\tNaN\tNaN\n");
  ASSERT_EQ(list.events.size(), 2u);
  EXPECT_EQ(list.without_magnitude, 1);
  EXPECT_EQ(list.events[1].time, 8782.0);
}

TEST(Earthquakes, YearsOfTwoDigitsAreRefused) {
  for (const char *const year : {"83.45", "99.99", "0.01", "83", "-5", "12345"}) {
    const std::string file = std::string("-116.5 33.5 ") + year + " 6 15 2.1 5 0 0\n";
    refused(file, "file:1: no event of ZMAP, expected longitude, latitude, year (of four");
  }
  refused("year,month,day,lat,lon,mag\n83,6,15,1,1,4\n",
          "file:2: time is '83 6 15', expected a year from 100 to 9999 instead of 83");
}

/// Times of the events in lines of these columns, in seconds after 2022-10-13T00:00.
std::vector<double> seconds_of(const std::string &columns, const std::string &lines) {
  std::string text = columns + ",lat,lon,mag\n";
  for (const char c : lines) text += c == '\n' ? ",1,1,4\n" : std::string(1, c);
  std::vector<double> seconds;
  for (const Earthquake &event : read(text).events)
    seconds.push_back(std::round((event.time - 19278.0) * 86400e3) / 1e3);
  return seconds;
}

TEST(Earthquakes, ColumnsOfTheTime) {
  const struct {
    std::string columns, line;
  } cases[] = {{"year,mon,day,hour,minu,sec", "2022,10,13,6,29,41.1"},
               {"year,month,day,hours,minutes,seconds", "2022,10,13,6,29,41.1"},
               {"Year,Mo,Dy,Hr,Mn,Sec", "2022,10,13,6,29,41.1"},
               {"YYYY,MM,DD,HH,MM,SS", "2022,10,13,6,29,41.1"},
               {"dd,mm,yyyy,hh,mm,ss.s", "13,10,2022,6,29,41.1"},
               {"year,m,d,h,m,s", "2022,Oct,13,6,29,41.1"},
               {"date,hour,minute,second", "2022-10-13,6,29,41.1"},
               {"second,minute,hour,date", "41.1,29,6,2022/10/13"},
               {"Origin Date,Origin_Hour,originMinute,sec (UTC)", "20221013,6,29,41.1"},
               {"year,month,day,HRMN,sec", "2022,10,13,0629,41.1"},
               {"DATE,HHMM,SEC", "20221013,629,41.1"},
               {"yyyy-mm-dd,hh:mm:ss.ss", "2022-10-13,06:29:41.10"},
               {"date,UTC", "2022-10-13,06:29:41.1"},
               {"Date (dd/mm/yyyy),Time (UTC)", "13/10/2022,06:29:41.1"},
               {"date,time", "2022-10-13T06:29:41.1Z,2022-10-13T06:29:41.1Z"},
               {"time,hour,minute,second", "2022-10-13 06:29,6,29,41.1"},
               {"fecha,hora,fecha UTC,hora UTC", "2022-10-12,23:29:41.1,2022-10-13,06:29:41.1"},
               {"anio,mes,dia,hora,minuto,segundo", "2022,10,13,6,29,41.1"},
               {"Año,Mes,Día,Hora,Min,Seg", "2022,10,13,6,29,41.1"},
               {"année,mois,jour,heure,minute,seconde", "2022,10,13,6,29,41.1"},
               {"anno,mese,giorno,ora,minuti,secondi", "2022,10,13,6,29,41.1"},
               {"Jahr,Monat,Tag,Stunde,Minute,Sekunde", "2022,10,13,6,29,41.1"},
               {"date,time,timezone", "2022-10-13,15:29:41.1,+09:00"},
               {"year,month,day,time", "2022,10,13,062941.1"},
               {"year,month,day,ot,Mo", "2022,10,13,0629 41.1,5.6e26"},
               {"year,month,day,hour,minute,second,time", "2022,10,13,6,29,41.1,2022.7815"}};
  for (const auto &one : cases) {
    const std::vector<double> seconds = seconds_of(one.columns, one.line + "\n");
    ASSERT_EQ(seconds.size(), 1u) << one.columns;
    EXPECT_NEAR(seconds[0], 6 * 3600 + 29 * 60 + 41.1, 1e-4) << one.columns;
  }
}

TEST(Earthquakes, NoPartOfATimeIsDroppedInSilence) {
  const struct {
    std::string columns, line, says;
  } cases[] = {
      {"year,month,day,hour,second", "2022,10,13,6,41.1", "the minute as well as the second"},
      {"year,month,day,minute", "2022,10,13,29", "the hour as well as the minute"},
      {"date,hour,minute", "2022-10-13,,29", "the hour as well as the minute"},
      {"year,month,day,hour", "2022,10,13,6", "a column of minutes next to that of hours"},
      {"year,month,day,hour", "2022,,13,6", "the month as well as the hour"},
      {"date,Saat", "2022-10-13,06:29:41.1", "a name such as time for the column of '06:29:41.1'"},
      {"date,local time", "2022-10-13,14:29:41.1", "a name such as time for the column of"},
      {"date,time,ampm", "2022-10-13,06:29:41,PM", "no column ampm"},
      {"date,time,msec", "2022-10-13,06:29:41,100", "no column msec"},
      {"year,doy,hour,minute", "2022,286,6,29", "the month as well as the minute"},
      {"date,time,hour", "2022-10-13,06:29:41,14", "the same time in the column 'hour'"},
      {"date,time", "2022-10-13,2022-10-14T06:29", "the same time in the column 'date'"},
      {"year,month,day,time", "2022,10,13,2022.19034", "a decimal year on the day"},
      {"time", "2011.19034", "hhmm, hhmmss or hh:mm:ss"},
      {"date,time", "221013,06:29", "a possible date with a year of four digits"},
      {"date,time", "13/10/22,06:29", "a possible date with a year of four digits"}};
  for (const auto &one : cases)
    expect_error<FileError>([&] { seconds_of(one.columns, one.line + "\n"); }, one.says);
}

// What a text by itself leaves open follows from all of its column.
TEST(Earthquakes, TheWholeFileSaysWhatTextsMean) {
  const double day = 86400.0;
  const std::string time = "year,month,day,time";
  EXPECT_EQ(seconds_of(time, "2022,10,13,0546\n2022,10,13,1446\n"),
            (std::vector<double>{5 * 3600 + 46 * 60, 14 * 3600 + 46 * 60}));
  EXPECT_EQ(seconds_of(time, "2022,10,13,1446\n2022,10,13,54624\n"),
            (std::vector<double>{14 * 60 + 46, 5 * 3600 + 46 * 60 + 24}));
  EXPECT_EQ(seconds_of(time, "2022,10,13,2022.78\n2022,10,14,2022.79\n"),
            (std::vector<double>{0, day}));
  EXPECT_EQ(seconds_of("date,time", "11/10/2022,0:00\n13/10/2022,0:00\n"),
            (std::vector<double>{-2 * day, 0}));
  EXPECT_EQ(seconds_of("date", "10/11/2022\n10/13/2022\n"), (std::vector<double>{-2 * day, 0}));
  EXPECT_EQ(seconds_of("mm/dd/yyyy", "10/11/2022\n"), (std::vector<double>{-2 * day}));
  EXPECT_EQ(seconds_of("date", "11.11.2022\n").size(), 1u);
  const auto unclear = [](const std::string &columns, const std::string &lines, const char *says) {
    expect_error<FileError>([&] { seconds_of(columns, lines); }, says);
  };
  unclear(time, "2022,10,13,0546\n2022,10,13,144600\n", "either hhmm or hhmmss in the whole file");
  unclear("date", "06/02/2023\n07/02/2023\n", "a day above 12 somewhere in the file");
  unclear("date", "02-13-2023\n13-02-2023\n", "the day first in some dates");
  unclear("dd/mm/yyyy", "02/13/2023\n", "the day first in some dates");
}

TEST(Earthquakes, LinesThatAreNoneOfAFormat) {
  // A longitude is no magnitude, and a name no type.
  EXPECT_EQ(detect_format("2009/04/06 01:32:39.00 42.334 11.334 8.8 6.3 Mw\n"), "models");
  for (const char *line : {"2009/04/06 01:32:39.00 42.334 11.334 8.8 6.3 Mw 100 50\n",
                           "2009/04/06 01:32:39.00 ITALY 2.334 11.334 8.8 6.3 Mw 100 50\n"})
    refused(line, "file:1: ", "scedc");
  // The same with its names.
  const EarthquakeList list = read(
      "Date       Time             Lat       Lon  Depth   Mag Magt\n"
      "2009/04/06 01:32:39.00  42.3340   11.3340   8.80   6.30   Mw\n");
  ASSERT_EQ(list.events.size(), 1u);
  EXPECT_EQ(list.events[0].magnitude, 6.3);
  EXPECT_EQ(list.events[0].latitude, 42.334);
}

TEST(Earthquakes, OddTables) {
  const std::string names = "time,latitude,longitude,depth,mag,place\n", a = "2020-01-01,1,2,3,4,",
                    b = "2020-01-02,1,2,3,4,";
  for (const std::string &text :
       {names + a + "x\n" + names + b + "y\n",
        names + a + "x\nplace,mag,time,latitude,longitude,depth\ny,4,2020-01-02,1,2,3\n",
        names + a + "\"GLEN COE\nHIGHLAND, \"\"X\"\"\"\n" + b + "y\n",
        names + a + "GLEN COE, HIGHLAND\n" + b + "y\n", names + a + "x,\n" + b + "y,,\n",
        names + a + "\"not closed\n" + b + "y\n", "sep=,\n" + names + a + "x\n" + b + "y\n",
        "time,latitude,longitude,depth,mag,place,\n" + a + "x,\n" + b + "y,\n"}) {
    const EarthquakeList list = read(text);
    ASSERT_EQ(list.events.size(), 2u) << text;
    EXPECT_EQ(list.events[1].time, 18263.0) << text;
    EXPECT_EQ(list.events[1].magnitude, 4.0) << text;
  }
  refused("time;latitude;longitude;mag\n2020-01-01;56,1;-4,2;1,2\n",
          "latitude is '56,1', expected a number with a decimal point");
  refused("time,latitude,longitude,place,rms,mag,id\n2020-01-01,1,2,A, B,0.5,4,9\n",
          "8 fields, expected 7 (a field with a ',' needs quotes)");
  refused("time,latitude,longitude,place,mag\n2020-01-01,1,2,\"A,4\n2020-01-02,1,2,A,4\n",
          "file:2: 4 fields, expected 5 (a quote is not closed)");
  EXPECT_EQ(read("time,latitude,longitude,mag\n2020-01-01,40.18S,142.5 W,4\n").events[0].latitude,
            -40.18);
}

// The type 'n' stands for no magnitude, and the yearly files of 2003 have no type of the place.
TEST(Earthquakes, Scedc) {
  const EarthquakeList list = read(
      "1981/01/01 01:49:29.23 le 2.27 c    33.724 -118.832   0.6 A 1  10   20\n"
      "1981/01/01 04:13:55.64 le 0.00 n    33.249 -115.967   1.0 A 2  10   20\n"
      "2019/07/06 03:19:53.04 eq  l 7.10 w    35.770 -117.599   8.0 A  1         100  200\n"
      "2019/07/06 03:20:00.00 eq  l 0.00 n    35.770 -117.599   8.0 A  2          10   20\n"
      "2019/07/06 03:21:00.00 eq  l 1.00      35.770 -117.599   8.0 A  2          10   20\n");
  ASSERT_EQ(list.events.size(), 3u);
  EXPECT_EQ(list.without_magnitude, 2);
  EXPECT_EQ(list.events[0].magnitude, 2.27);
  EXPECT_EQ(list.events[0].longitude, -118.832);
  EXPECT_EQ(list.events[1].magnitude, 7.1);
}

// One table has the names of the columns of all of these.
TEST(Earthquakes, ColumnsOfAgencies) {
  const struct {
    const char *name;
    std::string text, format = "csv";
  } cases[] = {
      {"GeoNet",
       "publicid,eventtype,origintime,modificationtime,longitude, latitude, magnitude, depth\n"
       "x1,,1994-01-17T12:30:55.390Z,2020-02-17T00:21:34.988Z,-118.537,34.213,6.7,5.9\n"},
      {"FDSN",
       "#EventID | Time | Latitude | Longitude | Depth/km | Author | MagType | Magnitude | "
       "EventLocationName|EventType\n# a comment\n"
       "x1|1994-01-17T12:30:55.39|34.213|-118.537|3.6|||6.7|1 km; NNW, of Reseda|earthquake\n"},
      {"pyCSEP",
       "lon,lat,mag,time_string,depth,catalog_id,event_id\n"
       "-118.537,34.213,6.7,1994-01-17T12:30:55.390000,8.9,,x1\n"},
      {"year to second",
       "eventID,year,month,day,hour,minute,second,longitude,latitude,depth,magnitude\n"
       "1,1994,1,17,12,30,55.39,-118.537,34.213,150.0,6.7\n"},
      {"semicolons",
       "timestamp;longitude;latitude;depth;magnitude\n"
       "1994-01-17T21:30:55.390000+0900;-118.537;34.213;32.0;6.7\n"},
      {"tabs",
       "Year\tMonth\tDay\tTime\tLat\tLon\tMag\n1994\t1\t17\t12:30:55.39\t34.213\t-118.537\t6.7\n"},
      {"ISC",
       "EVENTID,TYPE,AUTHOR   ,DATE      ,TIME       ,LAT     ,LON      ,DEPTH,DEPFIX,AUTHOR   "
       ",TYPE  ,MAG \n1,ke,ISC,1994-01-17,12:30:55.39, 34.213,-118.537, 19.7,,GCMT,MW, 6.7\n"},
      {"ISC-GEM",
       "# ISC-GEM catalogue, 1904 on\n#\n#         date          ,  lat   ,   lon   , depth ,  unc "
       ",q,  mw  , unc ,q\n1994-01-17 12:30:55.39, 34.213,-118.537, 19.7,3.0,A,6.70,0.1,B\n"},
      {"NEIC's PDE",
       "Year,Month,Day,Time(hhmmss.mm)UTC,Latitude (deg),Longitude [deg],Magnitude,Depth/km\n"
       "1994,1,17,123055.39,34.213,-118.537,6.7,5\n"},
      {"ComCat's GeoJSON",
       "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{\"mag\""
       ":6.7,\"time\":758809855390,\"type\":\"earthquake\"},\"geometry\":{\"type\":\"Point\","
       "\"coordinates\":[-118.537,34.213,18.2]}}]}\n",
       "geojson"},
      {"EMSC's GeoJSON",
       "{\"features\":[{\"geometry\":{\"coordinates\":[-118.537,34.213,-8]},\"properties\":"
       "{\"time\":\"1994-01-17T12:30:55.39Z\",\"mag\":6.7,\"lat\":1,\"evtype\":\"ke\"}}]}",
       "geojson"}};
  for (const auto &one : cases) {
    EXPECT_EQ(detect_format(one.text), one.format) << one.name;
    const EarthquakeList list = read(one.text);
    ASSERT_EQ(list.events.size(), 1u) << one.name;
    EXPECT_NEAR((list.events[0].time - 8782.0) * 86400.0, 45055.39, 1e-4) << one.name;
    EXPECT_EQ(list.events[0].magnitude, 6.7) << one.name;
    EXPECT_EQ(list.events[0].latitude, 34.213) << one.name;
    EXPECT_EQ(list.events[0].longitude, -118.537) << one.name;
  }
  EXPECT_EQ(detect_format("#EventID|Time|Latitude|Longitude|Magnitude\n"), "csv");
  EXPECT_EQ(read("time\tlatitude\tlongitude\tmag\ttype\n2000-01-01\t1\t1\t4\t\n").events.size(),
            1u);
  const EarthquakeList early =
      read("year,month,day,hour,minute,second,lon,lat,mag\n1107,2,12,3,,nan,26.6,45.7,7.1\n");
  EXPECT_EQ(early.events.at(0).time, *parse_date("1107-02-12T03:00"));
}

TEST(Earthquakes, GeoJsonThatCannotBeRead) {
  const std::string good =
      "{\"properties\":{\"time\":0,\"mag\":null},\"geometry\":{\"coordinates\":[1,2,3]}}";
  EXPECT_EQ(read("{\"features\":[" + good + "]}").without_magnitude, 1);
  refused("{\"features\":[" + good + ",\n{]}", "file:2: no JSON, expected GeoJSON");
  refused("{\"a\":[]}", "file:1: no array 'features', expected GeoJSON");
  refused("{\"features\":[" + good + ",{\"properties\":{\"time\":\"x\"}}]}",
          "file: feature 2: time is 'x', expected a date and time");
  for (const char *const odd : {"1", "null", "{}", "{\"properties\":1,\"geometry\":[1]}",
                                "{\"properties\":{\"time\":{}},\"geometry\":{\"coordinates\":3}}"})
    refused("{\"features\":[" + std::string(odd) + "]}", "file: feature 1: ");
}

TEST(Earthquakes, Regions) {
  const auto holds = [](const char *region, double longitude, double latitude) {
    Earthquake event;
    event.longitude = longitude;
    event.latitude = latitude;
    return parse_region(region).contains(event);
  };
  EXPECT_TRUE(holds("-122/-114/32/37", -118, 34));
  EXPECT_TRUE(holds("238/246/32/37", -118, 34));
  EXPECT_FALSE(holds("-122/-114/32/37", -113, 34));
  EXPECT_FALSE(holds("-122/-114/32/37", -118, 38));
  EXPECT_TRUE(holds("170/-170/-30/0", 175, -20));
  EXPECT_TRUE(holds("170/-170/-30/0", -175, -20));
  EXPECT_FALSE(holds("170/-170/-30/0", 0, -20));
  for (const char *bad : {"", "1/2/3", "1/2/3/4/5", "1/2/4/3", "1/2/3/91", "a/2/3/4", "1/1/2/3"})
    EXPECT_THROW(parse_region(bad), std::invalid_argument) << bad;
}

class EarthquakeInput : public unit::Files {
 protected:
  std::string file(const std::string &content) {
    const std::string name = path("quakes.csv");
    spill(name, content);
    return name;
  }
};

TEST_F(EarthquakeInput, TableOfDaysAndMagnitudes) {
  const EventTable table = load_catalogue(file(csv), {});
  ASSERT_EQ(table.events.size(), 3u);
  EXPECT_TRUE(table.earthquakes());
  EXPECT_EQ(table.label, "quakes");
  EXPECT_EQ(table.events[0].t_start, 8780.0);
  EXPECT_EQ(std::log10(table.events[1].size) / 1.5, 6.7);
  ASSERT_EQ(table.repairs.size(), 1u);
  EXPECT_TRUE(contains(table.repairs[0], "left out 1 of type 'quarry blast'"));
  EXPECT_EQ(Threshold().of(table).size, size_of_magnitude(2.01));
}

TEST_F(EarthquakeInput, Selection) {
  CatalogueOptions options;
  options.min_size = size_of_magnitude(5.89);
  EXPECT_EQ(load_catalogue(file(csv), options).events.size(), 2u);
  options.to_day = *parse_date("1994-01-17T12:31");
  EXPECT_EQ(load_catalogue(file(csv), options).events.size(), 1u);
  options = {};
  options.paths = {file(csv)};
  options.regions = {"-119/-118/34/35", "-117/-116/33/34"};
  const auto tables = load_catalogues(options);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].events.size(), 2u);
  EXPECT_EQ(tables[1].events.size(), 1u);
  EXPECT_TRUE(contains(tables[1].repairs.back(), "left out 2 outside of -117/-116/33/34"));
  options = {};
  options.paths = {file(csv)};
  options.from_time = 1984;
  expect_error<std::invalid_argument>(
      [&] { load_catalogues(options); },
      "all catalogues are of earthquakes, expected a date such as 1984-01-01");
}

// Files that were joined by the shell, or whose downloads were in chunks.
TEST(Earthquakes, QuakemlOfSeveralDocuments) {
  const std::string comment = "<!-- <event> is no event here -->\n", mark = "\xef\xbb\xbf";
  const std::size_t begin = quakeml.find("<eventParameters"), end = quakeml.find("</q:quakeml>");
  const std::string parameters = quakeml.substr(begin, end - begin);
  for (const std::string &content :
       {quakeml + quakeml + quakeml,
        mark + quakeml + "\r\n" + mark + quakeml + comment + quakeml + comment,
        quakeml.substr(0, end) + parameters + parameters + "</q:quakeml>"}) {
    const EarthquakeList list = read(content);
    EXPECT_EQ(list.events.size(), 9u);
    EXPECT_EQ(list.others.at("quarry blast"), 3);
  }
  // Wherever the blocks end in which a file is read.
  for (std::size_t gap = 0; gap < quakeml.size(); gap += 3) {
    const std::string blanks((1 << 16) - quakeml.size() - gap, ' ');
    EXPECT_EQ(read(quakeml + blanks + quakeml).events.size(), 6u) << gap;
    EXPECT_EQ(
        read("<!--" + blanks + "-->" + quakeml.substr(quakeml.find("<q:")) + quakeml).events.size(),
        6u)
        << gap;
  }
  refused(quakeml + "\n" + quakeml.substr(0, 900), "file:");
  refused(quakeml + "<html><body>Too many requests</body></html>",
          "file: no element eventParameters");
  refused(quakeml + "Error 413: too many events", "expected QuakeML");
  refused("<quakeml><eventParameters><event></eventParameters></quakeml>",
          "file:1: mismatched tag");
  refused(quakeml.substr(0, 900), "expected QuakeML");
  refused("<!-- nothing -->", "expected QuakeML");
  const std::string wrong =
      quakeml +
      "\n<quakeml><eventParameters>\n<event><origin/></event></eventParameters></quakeml>";
  const auto lines = std::count(quakeml.begin(), quakeml.end(), '\n');
  refused(wrong, "file:" + std::to_string(lines + 3) + ": time is ''");
}

// What leaves an event out is asked before what it lacks.
TEST(Earthquakes, EventsWithoutOrigin) {
  const std::size_t end = quakeml.find("</eventParameters>");
  const std::string
      gone = "<event publicID=\"quakeml:6\"><type>not existing</type></event>\n",
      none =
          "<event publicID=\"quakeml:7\"><magnitude><mag><value>5</value></mag></magnitude></event>\n";
  const EarthquakeList list = read(quakeml.substr(0, end) + gone + none + quakeml.substr(end));
  EXPECT_EQ(list.events.size(), 3u);
  EXPECT_EQ(list.others.at("not existing"), 1);
  EXPECT_EQ(list.without_origin, 1);
  EXPECT_EQ(
      read("time,latitude,longitude,mag,type\n2020-01-01,1,2,3,earthquake\n?,?,?,?,quarry blast\n")
          .events.size(),
      1u);
}

TEST(Earthquakes, NumbersThatStandForNoMagnitude) {
  std::string good = "time,latitude,longitude,mag\n";
  for (int k = 0; k < 30; ++k)
    good += "2020-01-01,1,2," + std::to_string(2.5 + 0.1 * (k % 9)).substr(0, 3) + "\n";
  for (const char *none : {"-9", "-9.9", "-9.99", "-99", "-99.0", "-999", "-9999.00", "99", "99.9",
                           "99.99", "9.99", "9.90", "-10", "999"}) {
    const EarthquakeList list = read(good + "2020-01-02,1,2," + none + "\n");
    EXPECT_EQ(list.events.size(), 30u) << none;
    EXPECT_EQ(list.fillers.at(none), 1);
  }
  for (const char *none : {"0", "0.0", "-1", "-1.00", "-5"}) {
    const std::string line = std::string("2020-01-02,1,2,") + none + "\n";
    EXPECT_EQ(read(good + line + line + line).events.size(), 30u) << none;
    EXPECT_EQ(read(good + line + line).events.size(), 32u) << none;  // too few to tell
  }
  for (const char *some : {"-3.2", "-1.5", "0.9", "9.5", "-8.5"}) {
    const std::string line = std::string("2020-01-02,1,2,") + some + "\n";
    EXPECT_EQ(read(good + line + line + line).events.size(), 33u) << some;
  }
  // Small earthquakes fill the range down to 0.
  std::string small = good;
  for (int k = 0; k < 10; ++k)
    small += "2020-01-02,1,2," + std::to_string(0.2 * k).substr(0, 3) + "\n";
  EXPECT_EQ(read(small + "2020-01-02,1,2,0.0\n2020-01-02,1,2,0.0\n").events.size(), 42u);
  // Where agencies have columns of their own, 0 beside another magnitude is none.
  const EarthquakeList list = read(
      "time,latitude,longitude,xM,MD,ML,Mw\n2020-01-01,1,2,4.1,4.1,0.0,0.0\n2020-01-02,1,2,5.0,0.0,4.9,5.0\n");
  ASSERT_EQ(list.events.size(), 1u);
  EXPECT_EQ(list.events[0].magnitude, 5.0);
  EXPECT_EQ(list.fillers.at("0"), 1);
}

TEST(Earthquakes, GeojsonThatIsNone) {
  const std::string
      head =
          "{\"type\":\"FeatureCollection\",\n\"features\":[{\"type\":\"Feature\",\n\"properties\":",
      tail = ",\"geometry\":{\"type\":\"Point\",\"coordinates\":[142,38,10]}}]}\n",
      good = "{\"mag\":5,\"time\":1299822384120}";
  EXPECT_EQ(read(head + good + tail).events.size(), 1u);
  EXPECT_EQ(read(head + "{\"mag\":5,\"time\":1299822384120,\"products\":{\"a\":[1,[2]]}}" + tail)
                .events.size(),
            1u);
  const std::string deep(100000, '[');
  refused(head + "{\"x\":" + deep + std::string(100000, ']') + "}" + tail,
          "file: JSON nested more than 100 levels deep");
  refused(head + "{\"mag\":5,\"place\":\"Izmir K\xf6rfezi\"}" + tail,
          "file:3: text that is not UTF-8");
  refused(head + good, "the file is truncated");
  refused(head + "{\"mag\":1e400,\"time\":1}" + tail, "file:3: 1e400 is too large a number");
  refused(head + good + tail + head + good + tail, "file:4: text after the end of the collection");
  refused(head + "{\"mag\":[5],\"time\":1299822384120}" + tail,
          "feature 1: magnitude is 'array', expected a number");
  refused(head + "{\"mag\":5,\"time\":1299822384.12}" + tail, "expected milliseconds since 1970");
  refused(head + "{\"mag\":5,\"time\":1299822384120000}" + tail,
          "expected milliseconds since 1970");
}

}  // namespace
